#include "plugin/record/lists.h"

#include <cstdio>

#include "plugin/record/engine.h"
#include "plugin/record/renderSettings.h"
#include "plugin/record/stage.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

void printLines(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
        std::printf("%s\n", line.c_str());
}

} // namespace

void printLists(const Options& options) {
    if (options.listRenderers) printLines(listRenderers());
    if (options.listCameras)
        for (const SdfPath& camera : listCameras(openStage(options.scene, options.mask)))
            std::printf("%s\n", camera.GetText());
    if (!options.listSettings && !options.listAovs) return;
    const Engine engine(options.renderer, options.device);
    if (options.listSettings) std::fputs(describeSettings(engine.delegate()).c_str(), stdout);
    if (options.listAovs) printLines(listAovs(engine));
}

} // namespace hipr::record
