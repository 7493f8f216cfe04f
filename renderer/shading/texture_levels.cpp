#include "renderer/shading/texture_levels.h"

#include <algorithm>
#include <cstring>

#include "renderer/shading/texels.h"

namespace hipr {

namespace {

/// The weight of colours where alpha is 0: where all of them are hidden they count alike.
constexpr float Hidden = 1.f / 4096.f;

/// How much of cell `fine` of `fineCount` lies in cell `coarse` of `coarseCount`, as a share of the latter.
float share(uint64_t fine, uint64_t fineCount, uint64_t coarse, uint64_t coarseCount) {
    const uint64_t begin = std::max(fine * coarseCount, coarse * fineCount);
    const uint64_t end = std::min((fine + 1) * coarseCount, (coarse + 1) * fineCount);
    return end > begin ? float(end - begin) / float(fineCount) : 0.f;
}

/// A row at another width.
void narrowRow(const std::vector<glm::vec4>& in, std::vector<glm::vec4>& out) {
    const size_t from = in.size(), to = out.size();
    if (from == 2 * to) {
        for (size_t x = 0; x < to; ++x)
            out[x] = 0.5f * (in[2 * x] + in[2 * x + 1]);
        return;
    }
    for (size_t x = 0; x < to; ++x) {
        out[x] = glm::vec4(0.f);
        for (size_t i = x * from / to; i < from && i * to < (x + 1) * from; ++i)
            out[x] += share(i, from, x, to) * in[i];
    }
}

} // namespace

LevelSize coarserLevel(LevelSize size) {
    return {std::max(size.width / 2, 1u), std::max(size.height / 2, 1u)};
}

std::vector<LevelSize> levelSizes(LevelSize finest) {
    std::vector<LevelSize> sizes{finest};
    while (sizes.back().width > 1 || sizes.back().height > 1)
        sizes.push_back(coarserLevel(sizes.back()));
    return sizes;
}

uint64_t levelBytes(const std::vector<LevelSize>& levels, uint32_t format) {
    uint64_t bytes = 0;
    for (const LevelSize& level : levels)
        bytes += uint64_t(level.width) * level.height * bytesPerTexel(format);
    return bytes;
}

LevelBuilder::LevelBuilder(LevelSize size, uint32_t format, bool weighted, uint32_t first,
                           unsigned char* texels)
    : _format(format), _weighted(weighted), _values(size.width) {
    for (const LevelSize& level : levelSizes(size)) {
        Level& made = _levels.emplace_back();
        made.size = level;
        if (_levels.size() > 1) made.narrow.resize(level.width), made.sum.resize(level.width);
        if (_levels.size() <= first) continue;
        made.texels = texels;
        texels += levelBytes({level}, format);
    }
}

void LevelBuilder::addRow(const unsigned char* texels) {
    Level& level = _levels[0];
    const size_t bytes = level.size.width * bytesPerTexel(_format);
    if (level.texels)
        std::memcpy(level.texels + size_t(level.size.height - 1 - level.rows) * bytes, texels, bytes);
    ++level.rows;
    if (_levels.size() == 1) return;
    decodeTexels(_format, texels, level.size.width, _values.data());
    if (_weighted)
        for (glm::vec4& v : _values) {
            v.w = std::max(v.w, 0.f) + Hidden;
            v = glm::vec4(glm::vec3(v) * v.w, v.w);
        }
    addRow(1, _values);
}

void LevelBuilder::addRow(size_t number, const std::vector<glm::vec4>& row) {
    Level& level = _levels[number];
    const uint32_t fine = _levels[number - 1].size.height, coarse = level.size.height, in = level.rows++;
    narrowRow(row, level.narrow);
    for (uint32_t out = uint32_t(uint64_t(in) * coarse / fine);
         out < coarse && uint64_t(out) * fine < uint64_t(in + 1) * coarse; ++out) {
        const float weight = share(in, fine, out, coarse);
        for (size_t x = 0; x < level.sum.size(); ++x)
            level.sum[x] += weight * level.narrow[x];
        if (uint64_t(in + 1) * coarse >= uint64_t(out + 1) * fine) finishRow(number, out);
    }
}

void LevelBuilder::finishRow(size_t number, uint32_t row) {
    Level& level = _levels[number];
    if (level.texels) {
        _row = level.sum;
        if (_weighted)
            for (glm::vec4& v : _row)
                v = glm::vec4(glm::vec3(v) / v.w, v.w - Hidden);
        encodeTexels(_format, _row.data(), _row.size(),
                     level.texels +
                         size_t(level.size.height - 1 - row) * level.size.width * bytesPerTexel(_format));
    }
    if (number + 1 < _levels.size()) addRow(number + 1, level.sum);
    std::fill(level.sum.begin(), level.sum.end(), glm::vec4(0.f));
}

} // namespace hipr
