#include "testenv/edit/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

namespace hipr::test {

namespace {

float asFloat(uint32_t word) {
    float value;
    std::memcpy(&value, &word, 4);
    return value;
}

std::string pixelText(const Layer& layer, size_t pixel) {
    std::ostringstream out;
    out.precision(9);
    for (size_t c = 0; c < layer.components; ++c) {
        const uint32_t word = layer.words[pixel * layer.components + c];
        if (c) out << ' ';
        if (layer.integer)
            out << int32_t(word);
        else
            out << asFloat(word);
    }
    return out.str();
}

/// Describes pixels for which `same` is false.
template <class Same, class Text>
void compare(const std::string& what, const Picture& picture, Same same, Text text, std::ostringstream& out) {
    size_t count = 0, first = 0;
    const size_t pixels = size_t(picture.width) * size_t(picture.height);
    for (size_t i = pixels; i-- > 0;)
        if (!same(i)) ++count, first = i;
    if (count == 0) return;
    out << what << " differs in " << count << " pixels, first at (" << first % size_t(picture.width) << ", "
        << first / size_t(picture.width) << "), prim <" << picture.prims[first] << ">: " << text(first)
        << "\n";
}

/// The first few lines that only one of two sorted texts has.
void compareLines(const std::string& a, const std::string& b, std::ostringstream& out) {
    constexpr int most = 6;
    std::istringstream inA(a), inB(b);
    std::string lineA, lineB;
    bool hasA = bool(std::getline(inA, lineA)), hasB = bool(std::getline(inB, lineB));
    for (int shown = 0; (hasA || hasB) && shown < most;) {
        if (hasA && hasB && lineA == lineB) {
            hasA = bool(std::getline(inA, lineA)), hasB = bool(std::getline(inB, lineB));
            continue;
        }
        const bool first = hasA && (!hasB || lineA < lineB);
        out << "scene: only " << (first ? "the first has " + lineA : "the second has " + lineB) << "\n";
        ++shown;
        if (first)
            hasA = bool(std::getline(inA, lineA));
        else
            hasB = bool(std::getline(inB, lineB));
    }
}

} // namespace

std::string usedFacts(const std::string& dump) {
    struct Line {
        std::string kind, name, text;
    };
    std::vector<Line> lines;
    std::set<std::string> named, hidden;
    std::istringstream in(dump);
    for (std::string text; std::getline(in, text);) {
        std::istringstream words(text);
        Line line{"", "", text};
        words >> line.kind >> line.name;
        if (text == "object " + line.name + " visible false") hidden.insert(line.name);
        for (std::string word; line.kind != "material" && words >> word;)
            named.insert(word);
        lines.push_back(std::move(line));
    }
    std::string facts;
    for (const Line& line : lines) {
        const bool unused =
            line.kind == "material" ? named.count(line.name) == 0 : hidden.count(line.name) > 0;
        if (!unused) facts += line.text + "\n";
    }
    return facts;
}

std::string Picture::differenceTo(const Picture& other) const {
    if (width != other.width || height != other.height || layers.size() != other.layers.size())
        return "the size differs";
    std::ostringstream out;
    compare(
        "prim", *this, [&](size_t i) { return prims[i] == other.prims[i]; },
        [&](size_t i) { return "<" + prims[i] + "> and <" + other.prims[i] + ">"; }, out);
    for (size_t l = 0; l < layers.size(); ++l) {
        const Layer &a = layers[l], &b = other.layers[l];
        const size_t n = a.components;
        compare(
            a.aov, *this,
            [&](size_t i) { return std::equal(&a.words[i * n], &a.words[i * n] + n, &b.words[i * n]); },
            [&](size_t i) { return pixelText(a, i) + " and " + pixelText(b, i); }, out);
    }
    if (scene != other.scene) compareLines(scene, other.scene, out);
    return out.str();
}

void Picture::save(const std::string& path) const {
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << width << " " << height << "\n255\n";
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c) {
                const float value = asFloat(layers[0].words[(size_t(y) * size_t(width) + size_t(x)) * 4 + c]);
                out.put(char(255.f * std::pow(std::clamp(value, 0.f, 1.f), 1 / 2.2f)));
            }
}

} // namespace hipr::test
