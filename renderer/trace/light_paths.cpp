#include "renderer/trace/light_paths.h"

#include <algorithm>

namespace hipr {

void LightPaths::refuse(const std::string& expression, const std::string& why) {
    if (_refused.insert(expression).second)
        _device.messages()(Severity::Warning, "lpe:" + expression, why + "; this AOV stays black");
}

void LightPaths::clear() {
    _expressions.clear();
    _automaton = {};
    _next = {}, _accepted = {}, _groups = {}, _film = {};
}

void LightPaths::set(const std::vector<AovRequest>& aovs, uint64_t pixels) {
    clear();
    std::vector<PathExpression> parsed;
    for (const AovRequest& aov : aovs) {
        const auto known = std::find(_expressions.begin(), _expressions.end(), aov.name);
        if (aov.kind != AovKind::Lpe || known != _expressions.end()) continue;
        std::string problem;
        if (!parsePathExpression(aov.name, parsed.emplace_back(), problem)) {
            parsed.pop_back();
            refuse(aov.name, problem);
            continue;
        }
        PathAutomaton automaton;
        if (!buildAutomaton(parsed, automaton)) {
            parsed.pop_back();
            refuse(aov.name,
                   "the light path expressions are more, or more complicated, than there is room for");
            continue;
        }
        _automaton = std::move(automaton);
        _expressions.push_back(aov.name);
    }
    if (_expressions.empty() || pixels == 0) return;
    std::vector<uint32_t> groups;
    for (const std::string& label : _automaton.labels)
        groups.push_back(_names.intern(label));
    _next = _device.createFrom(_automaton.next.data(), _automaton.next.size(), "Film");
    _accepted = _device.createFrom(_automaton.accepted.data(), _automaton.accepted.size(), "Film");
    _groups = _device.createFrom(groups.data(), groups.size(), "Film");
    _film =
        _device.createBuffer(pixels * _expressions.size() * sizeof(gpu::LpePixel), MemoryUse::Device, "Film");
    _device.run([&](VkCommandBuffer cmd) { vkCmdFillBuffer(cmd, _film.handle(), 0, VK_WHOLE_SIZE, 0); });
}

gpu::LpeRecord LightPaths::record() const {
    gpu::LpeRecord record{};
    if (!_film) return record;
    record.next = _next.address();
    record.accepted = _accepted.address();
    record.groups = _groups ? _groups.address() : 0;
    record.film = _film.address();
    record.symbols = _automaton.symbols;
    record.groupCount = uint32_t(_automaton.labels.size());
    record.count = uint32_t(_expressions.size());
    record.start = _automaton.start;
    return record;
}

void LightPaths::read(const std::string& expression, const gpu::FilmPixel* sums, uint64_t pixels,
                      float* rgb) const {
    const auto found = std::find(_expressions.begin(), _expressions.end(), expression);
    if (found == _expressions.end()) {
        std::fill_n(rgb, 3 * pixels, 0.f);
        return;
    }
    std::vector<gpu::LpePixel> copy;
    const size_t count = _expressions.size();
    const gpu::LpePixel* film = _film.mapped<gpu::LpePixel>();
    if (!film) {
        copy.resize(pixels * count);
        _device.download(_film, copy.data(), copy.size() * sizeof(gpu::LpePixel));
        film = copy.data();
    }
    film += found - _expressions.begin();
    for (uint64_t i = 0; i < pixels; ++i, film += count, rgb += 3)
        for (int c = 0; c < 3; ++c)
            rgb[c] = film->sum[c] / float(std::max(sums[i].count, 1u));
}

} // namespace hipr
