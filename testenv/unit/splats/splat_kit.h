/// Clouds, and files that hold them in every dialect, for the tests of this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/splats/splat_file.h"

namespace hipr::test {

/// Keeps every message as "subject: text".
struct Messages {
    std::vector<std::string> texts;

    SplatReadOptions options() {
        SplatReadOptions options;
        options.name = "/cloud";
        options.messages = [this](Severity, const std::string& subject, const std::string& text) {
            texts.push_back(subject + ": " + text);
        };
        return options;
    }
};

inline ByteView view(const std::string& file) {
    return {reinterpret_cast<const unsigned char*>(file.data()), file.size()};
}

/// The message of the SplatFileError that reading gives; empty when it gives none.
inline std::string errorOf(const std::string& file) {
    Messages messages;
    try {
        readSplats(view(file), messages.options());
    } catch (const SplatFileError& error) {
        return error.what();
    }
    return "";
}

inline SplatCloud readQuietly(const std::string& file) {
    Messages messages;
    SplatCloud cloud = readSplats(view(file), messages.options());
    EXPECT_EQ(messages.texts, std::vector<std::string>());
    return cloud;
}

inline SplatCloud randomCloud(size_t count, uint32_t degree, uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> symmetric(-1.f, 1.f), positive(0.01f, 0.99f);
    const auto vector = [&] { return glm::vec3(symmetric(random), symmetric(random), symmetric(random)); };
    SplatCloud cloud;
    cloud.name = "/cloud";
    cloud.shDegree = degree;
    for (size_t i = 0; i < count; ++i) {
        cloud.positions.push_back(10.f * vector());
        const glm::vec3 v = vector();
        cloud.orientations.push_back(glm::normalize(glm::quat(symmetric(random), v.x, v.y, v.z)));
        cloud.scales.push_back(glm::exp(4.f * vector()));
        cloud.opacities.push_back(positive(random));
        for (uint32_t k = 0; k < shCoefficients(degree); ++k)
            cloud.coefficients.push_back(vector());
    }
    return cloud;
}

/// A property of a PLY file: its name, its type's name, and its value for each splat.
struct Column {
    std::string name, type = "float";
    std::vector<double> values;
};

/// The columns of a cloud as the reference implementation names and encodes them.
inline std::vector<Column> columnsOf(const SplatCloud& cloud) {
    std::vector<Column> columns;
    const auto add = [&](const std::string& name, auto&& value) {
        Column column{name, "float", {}};
        for (size_t i = 0; i < cloud.size(); ++i)
            column.values.push_back(double(value(i)));
        columns.push_back(column);
    };
    const uint32_t coefficients = shCoefficients(cloud.shDegree), rest = coefficients - 1;
    for (int axis = 0; axis < 3; ++axis)
        add(std::string(1, char('x' + axis)), [&](size_t i) { return cloud.positions[i][axis]; });
    for (uint32_t channel = 0; channel < 3; ++channel)
        add("f_dc_" + std::to_string(channel),
            [&](size_t i) { return cloud.coefficients[i * coefficients][int(channel)]; });
    for (uint32_t n = 0; n < 3 * rest; ++n)
        add("f_rest_" + std::to_string(n),
            [&](size_t i) { return cloud.coefficients[i * coefficients + 1 + n % rest][int(n / rest)]; });
    add("opacity", [&](size_t i) { return -std::log(1.0 / double(cloud.opacities[i]) - 1.0); });
    for (int axis = 0; axis < 3; ++axis)
        add("scale_" + std::to_string(axis), [&](size_t i) { return std::log(cloud.scales[i][axis]); });
    add("rot_0", [&](size_t i) { return cloud.orientations[i].w; });
    add("rot_1", [&](size_t i) { return cloud.orientations[i].x; });
    add("rot_2", [&](size_t i) { return cloud.orientations[i].y; });
    add("rot_3", [&](size_t i) { return cloud.orientations[i].z; });
    return columns;
}

inline Column& columnNamed(std::vector<Column>& columns, const std::string& name) {
    return *std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
}

/// A number as a file of a format holds it.
inline std::string encoded(double value, const std::string& type, const std::string& format) {
    if (format == "ascii") {
        std::ostringstream text;
        text.precision(17);
        text << value << ' ';
        return text.str();
    }
    std::string bytes;
    const auto append = [&](auto number) {
        bytes.resize(sizeof(number));
        std::memcpy(bytes.data(), &number, sizeof(number));
    };
    if (type == "double")
        append(value);
    else if (type == "float" || type == "float32")
        append(float(value));
    else if (type == "int" || type == "uint")
        append(int64_t(value) < 0 ? uint32_t(int32_t(value)) : uint32_t(value));
    else if (type == "short" || type == "ushort")
        append(uint16_t(int32_t(value)));
    else
        append(uint8_t(int32_t(value)));
    if (format == "binary_big_endian") std::reverse(bytes.begin(), bytes.end()); // tests run on little ones
    return bytes;
}

struct PlyStyle {
    std::string format = "binary_little_endian";
    std::string before = {}, bodyBefore = {}; ///< header lines and rows of elements before the vertices
    std::string after = {}, bodyAfter = {};   ///< and behind them
    std::string listAfter = {};               ///< a property after which each row has a list of three bytes
    std::string lineEnd = "\n";
};

inline std::string plyFile(const std::vector<Column>& columns, const PlyStyle& style = {}) {
    const size_t rows = columns.front().values.size();
    std::string file = "ply\nformat " + style.format + " 1.0\ncomment made by a test\n" + style.before +
                       "element vertex " + std::to_string(rows) + "\n";
    for (const Column& column : columns) {
        file += "property " + column.type + " " + column.name + "\n";
        if (column.name == style.listAfter) file += "property list uchar uchar extra\n";
    }
    file += style.after + "end_header\n";
    for (size_t at = 0; style.lineEnd != "\n" && (at = file.find('\n', at)) != file.npos; at += 2)
        file.replace(at, 1, style.lineEnd);
    file += style.bodyBefore;
    for (size_t row = 0; row < rows; ++row) {
        for (const Column& column : columns) {
            file += encoded(column.values[row], column.type, style.format);
            if (column.name != style.listAfter) continue;
            for (const int item : {3, 7, 8, 9})
                file += encoded(item, "uchar", style.format);
        }
        if (style.format == "ascii") file += style.lineEnd;
    }
    return file + style.bodyAfter;
}

/// Equal but for what rounding does on the way through logarithms.
inline void expectNear(const SplatCloud& a, const SplatCloud& b, float tolerance = 1e-5f) {
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(a.shDegree, b.shDegree);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.coefficients, b.coefficients);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a.opacities[i], b.opacities[i], tolerance);
        EXPECT_NEAR(std::abs(glm::dot(a.orientations[i], b.orientations[i])), 1.f, tolerance);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(a.scales[i][axis] / b.scales[i][axis], 1.f, tolerance);
    }
}

} // namespace hipr::test
