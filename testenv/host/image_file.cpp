#include "testenv/host/image_file.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hipr::test {

namespace {

template <class T>
std::vector<T> readChannel(const std::string& path, const OIIO::ImageSpec& spec, const std::string& name,
                           OIIO::TypeDesc type) {
    std::vector<T> values(size_t(spec.width) * size_t(spec.height));
    const int channel = spec.channelindex(name);
    const auto input = OIIO::ImageInput::open(path);
    if (channel < 0 || !input || !input->read_image(0, 0, channel, channel + 1, type, values.data()))
        ADD_FAILURE() << "cannot read channel " << name << " of " << path;
    return values;
}

} // namespace

ImageFile::ImageFile(const std::string& path) : _path(path) {
    if (const auto input = OIIO::ImageInput::open(path))
        _spec = input->spec();
    else
        ADD_FAILURE() << "cannot read " << path << ": " << OIIO::geterror();
}

bool ImageFile::hasChannel(const std::string& name) const {
    return _spec.channelindex(name) >= 0;
}

std::string ImageFile::channelType(const std::string& name) const {
    const int channel = _spec.channelindex(name);
    return channel < 0 ? "" : _spec.channelformat(channel).c_str();
}

size_t ImageFile::pixel(double x, double y) const {
    const int column = std::clamp(int(x * _spec.width), 0, _spec.width - 1);
    const int row = std::clamp(int(y * _spec.height), 0, _spec.height - 1);
    return size_t(row) * size_t(_spec.width) + size_t(column);
}

std::vector<float> ImageFile::values(const std::string& channel) const {
    return readChannel<float>(_path, _spec, channel, OIIO::TypeFloat);
}

float ImageFile::at(const std::string& channel, double x, double y) const {
    return values(channel)[pixel(x, y)];
}

uint32_t ImageFile::idAt(const std::string& channel, double x, double y) const {
    return ids(channel)[pixel(x, y)];
}

std::vector<uint32_t> ImageFile::ids(const std::string& channel) const {
    return readChannel<uint32_t>(_path, _spec, channel, OIIO::TypeUInt);
}

} // namespace hipr::test
