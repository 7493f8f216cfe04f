/// Files of .spz made from numbers as they stand in them.
#pragma once

#include <zlib.h>

#include "splat_kit.h"

namespace hipr::test {

inline std::string gzipped(const std::string& content) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string file(deflateBound(&stream, uLong(content.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
    stream.avail_in = uInt(content.size());
    stream.next_out = reinterpret_cast<Bytef*>(file.data());
    stream.avail_out = uInt(file.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    file.resize(stream.total_out);
    deflateEnd(&stream);
    return file;
}

inline std::string little(uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> (8 * i) & 0xff);
    return text;
}

struct SpzHeader {
    uint32_t version = 3, count = 1, degree = 0, fractionalBits = 12;
    uint32_t magic = 0x5053474e;

    std::string bytes() const {
        return little(magic, 4) + little(version, 4) + little(count, 4) + little(degree, 1) +
               little(fractionalBits, 1) + little(0, 2);
    }
};

/// A body of one splat: at (1, -2, 0.5), version 2 or 3.
inline std::string spzBody(const std::string& orientation, uint32_t degree = 0) {
    std::string body = little(1 << 12, 3) + little(uint64_t(-(2 << 12)), 3) + little(1 << 11, 3);
    body += little(51, 1);                                    // opacity 0.2
    body += little(255, 1) + little(0, 1) + little(51, 1);    // colour
    body += little(160, 1) + little(176, 1) + little(128, 1); // scales: exp(0), exp(1), exp(-2)
    body += orientation;
    for (uint32_t i = 0; i < 3 * (shCoefficients(degree) - 1); ++i)
        body += little(128 + 3 * i, 1);
    return body;
}

} // namespace hipr::test
