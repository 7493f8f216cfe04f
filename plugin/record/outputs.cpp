#include "plugin/record/outputs.h"

namespace hipr::record {

Output::Output(const ProductFile& file)
    : _pattern(file.path), _pathAtFrame(file.pathAtFrame), _layers(file.layers) {}

std::string Output::path(double frame) const {
    const auto named = _pathAtFrame.find(frame);
    return named != _pathAtFrame.end() ? named->second : _pattern.path(frame);
}

void Output::write(const std::string& path, const Picture& picture, const DisplayOptions& display) const {
    if (_layers.empty()) return writePicture(path, picture, display);
    Picture part{picture.width, picture.height, {}, picture.info};
    for (const LayerName& layer : _layers) {
        part.layers.push_back(*picture.find(layer.aov));
        part.layers.back().name = layer.name;
        part.layers.back().half |= layer.half;
    }
    writePicture(path, part, display);
}

std::vector<Output> outputsOf(const Options& options) {
    std::vector<Output> outputs;
    for (const std::string& path : options.outputs)
        outputs.emplace_back(path);
    for (const ProductFile& file : options.products)
        outputs.emplace_back(file);
    return outputs;
}

} // namespace hipr::record
