/// @file image_file.h
/// Image files read back for inspection.
#pragma once

#include <OpenImageIO/imageio.h>
#include <cstdint>
#include <string>
#include <vector>

namespace hipr::test {

class ImageFile {
public:
    /// Fails the running test and stays empty when the file cannot be read.
    explicit ImageFile(const std::string& path);

    const OIIO::ImageSpec& spec() const { return _spec; }
    bool hasChannel(const std::string& name) const;
    /// "float", "uint", "uint8"..., or "" when there is no such channel.
    std::string channelType(const std::string& name) const;
    /// Value at a place in the picture, (0, 0) top left to (1, 1) bottom right. 8-bit files read 0 to 1.
    float at(const std::string& channel, double x, double y) const;
    uint32_t idAt(const std::string& channel, double x, double y) const;
    /// All values of a channel.
    std::vector<float> values(const std::string& channel) const;
    std::vector<uint32_t> ids(const std::string& channel) const;

private:
    size_t pixel(double x, double y) const;
    std::string _path;
    OIIO::ImageSpec _spec;
};

} // namespace hipr::test
