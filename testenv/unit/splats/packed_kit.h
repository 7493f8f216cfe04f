/// Packed .ply files, written from the description of the format.
#pragma once

#include "splat_kit.h"

namespace hipr::test {

/// The least and the largest of some vectors, axis by axis.
struct Range {
    glm::vec3 lo{1e30f}, hi{-1e30f};
    void add(const glm::vec3& v) {
        lo = glm::min(lo, v);
        hi = glm::max(hi, v);
    }
    /// `v` as a number of so many bits.
    double part(const glm::vec3& v, int axis, int bits) const {
        const double most = double((1 << bits) - 1), size = double(hi[axis]) - double(lo[axis]);
        return size > 0 ? std::round((double(v[axis]) - double(lo[axis])) / size * most) : 0.0;
    }
    /// 11, 10 and 11 bits.
    double word(const glm::vec3& v) const {
        return part(v, 0, 11) * (1 << 21) + part(v, 1, 10) * (1 << 11) + part(v, 2, 11);
    }
};

inline glm::vec3 shownColour(const SplatCloud& cloud, size_t i) {
    return 0.5f + 0.28209479f * cloud.coefficients[i * shCoefficients(cloud.shDegree)];
}

inline double packedTurn(const glm::quat& q) {
    const double parts[] = {q.w, q.x, q.y, q.z};
    int largest = 0;
    for (int i = 1; i < 4; ++i)
        if (std::abs(parts[i]) > std::abs(parts[largest])) largest = i;
    double word = largest;
    for (int i = 0; i < 4; ++i)
        if (i != largest) {
            const double part = parts[largest] < 0 ? -parts[i] : parts[i];
            word = word * 1024 + std::round((part / std::sqrt(2.0) + 0.5) * 1023);
        }
    return word;
}

/// `coloured`: with the range of each chunk's colours; otherwise colours have to be from 0 to 1.
inline std::string packedFile(const SplatCloud& cloud, bool coloured = true,
                              const std::string& format = "binary_little_endian") {
    PlyStyle style;
    style.format = format;
    std::vector<Column> columns;
    for (const char* name : {"position", "rotation", "scale", "color"})
        columns.push_back({std::string("packed_") + name, "uint", {}});
    const auto rangeLines = [](const std::string& a, const std::string& b, const std::string& c) {
        std::string lines;
        for (const char* end : {"min_", "max_"})
            for (const std::string& axis : {a, b, c})
                lines += "property float " + std::string(end) + axis + "\n";
        return lines;
    };
    style.before = "element chunk " + std::to_string((cloud.size() + 255) / 256) + "\n" +
                   rangeLines("x", "y", "z") + rangeLines("scale_x", "scale_y", "scale_z") +
                   (coloured ? rangeLines("r", "g", "b") : "");
    for (size_t first = 0; first < cloud.size(); first += 256) {
        const size_t end = std::min(first + 256, cloud.size());
        Range positions, scales, colours;
        for (size_t i = first; i < end; ++i) {
            positions.add(cloud.positions[i]);
            scales.add(glm::log(cloud.scales[i]));
            colours.add(shownColour(cloud, i));
        }
        if (!coloured) colours = {glm::vec3(0), glm::vec3(1)};
        for (const Range* range : {&positions, &scales, &colours})
            for (const glm::vec3& corner : {range->lo, range->hi})
                for (int axis = 0; axis < 3 && (coloured || range != &colours); ++axis)
                    style.bodyBefore += encoded(corner[axis], "float", format);
        for (size_t i = first; i < end; ++i) {
            const glm::vec3 colour = shownColour(cloud, i);
            double word = 0;
            for (int c = 0; c < 3; ++c)
                word = word * 256 + colours.part(colour, c, 8);
            word = word * 256 + std::round(double(cloud.opacities[i]) * 255);
            columns[0].values.push_back(positions.word(cloud.positions[i]));
            columns[1].values.push_back(packedTurn(cloud.orientations[i]));
            columns[2].values.push_back(scales.word(glm::log(cloud.scales[i])));
            columns[3].values.push_back(word);
        }
    }
    const uint32_t all = shCoefficients(cloud.shDegree), rest = all - 1;
    if (rest > 0) style.after = "element sh " + std::to_string(cloud.size()) + "\n";
    for (uint32_t n = 0; n < 3 * rest; ++n)
        style.after += "property uchar f_rest_" + std::to_string(n) + "\n";
    for (size_t i = 0; i < cloud.size(); ++i)
        for (uint32_t n = 0; n < 3 * rest; ++n) {
            const double value = cloud.coefficients[i * all + 1 + n % rest][int(n / rest)];
            const double byte = std::floor((value + 4) / 8 * 256);
            style.bodyAfter += encoded(std::min(std::max(byte, 0.0), 255.0), "uchar", format);
        }
    return plyFile(columns, style);
}

} // namespace hipr::test
