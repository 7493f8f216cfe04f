/// @file material_traits.h
/// What can be told of a material without running its program.
#pragma once

#include "renderer/shading/material_inputs.h"

namespace hipr {

/// Whether the input is above `least` somewhere, as far as can be told.
bool mayExceed(const ResolvedInput& input, float least);

/// Whether highlights, or those of the coat, are stretched somewhere; `inputs` as ResolvedMaterial has them.
bool isStretched(const std::vector<ResolvedInput>& inputs);

bool isEmissive(const ResolvedMaterial& material);

/// About the luminance of what it emits, in nits, above 0 and finite if it is emissive: what textures,
/// primvars and graphs give counts as 1.
float emittedLuminance(const ResolvedMaterial& material);

} // namespace hipr
