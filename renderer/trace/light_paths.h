/// @file light_paths.h
/// The light path expressions of a film: their tables, and what they have brought to each pixel.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "renderer/api/film.h"
#include "renderer/lpe/automaton.h"
#include "renderer/shading/names.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/lpe.h"
#include "shaders/shared/trace.h"

namespace hipr {

class LightPaths {
public:
    LightPaths(Device& device, NameTable& names) : _device(device), _names(names) {}

    /// Those of the AOVs that are expressions. One that is none, or too many, are told, each once, and stay
    /// black.
    void set(const std::vector<AovRequest>& aovs, uint64_t pixels);
    void clear();
    bool any() const { return !_expressions.empty(); }
    /// What the path tracer needs to know of the film; `count` is 0 without expressions.
    gpu::LpeRecord record() const;
    /// The means of one expression. `sums`: of the same samples.
    void read(const std::string& expression, const gpu::FilmPixel* sums, uint64_t pixels, float* rgb) const;

private:
    void refuse(const std::string& expression, const std::string& why);

    Device& _device;
    NameTable& _names;
    std::vector<std::string> _expressions; ///< as in AovRequest::name, in the order of their bits
    PathAutomaton _automaton;
    Buffer _next, _accepted, _groups, _film;
    std::set<std::string> _refused; ///< what was told of
};

} // namespace hipr
