#include "renderer/shading/material_traits.h"

#include <algorithm>

#include "shaders/shared/material.h"

namespace hipr {

using Source = MaterialInput::Source;

bool mayExceed(const ResolvedInput& input, float least) {
    return input.kind != Source::Constant || input.constant.x > least;
}

bool isStretched(const std::vector<ResolvedInput>& inputs) {
    return inputs.size() == gpu::INPUT_COUNT && (mayExceed(inputs[gpu::INPUT_SPECULAR_ANISOTROPY], 0.f) ||
                                                 mayExceed(inputs[gpu::INPUT_COAT_ANISOTROPY], 0.f));
}

bool isEmissive(const ResolvedMaterial& material) {
    const ResolvedInput& color = material.inputs[gpu::INPUT_EMISSION_COLOR];
    const bool colored = color.kind != Source::Constant || glm::vec3(color.constant) != glm::vec3(0.f);
    return colored && (material.model != MaterialModel::OpenPbr ||
                       mayExceed(material.inputs[gpu::INPUT_EMISSION_LUMINANCE], 0.f));
}

float emittedLuminance(const ResolvedMaterial& material) {
    const auto typical = [](const ResolvedInput& input) {
        if (input.kind == Source::Constant) return input.constant;
        if (input.kind != Source::Texture) return glm::vec4(1.f);
        return glm::max(glm::abs(input.scale + input.bias), glm::abs(input.bias));
    };
    glm::vec4 emitted = typical(material.inputs[gpu::INPUT_EMISSION_COLOR]);
    if (material.model == MaterialModel::OpenPbr)
        emitted *= typical(material.inputs[gpu::INPUT_EMISSION_LUMINANCE]).x;
    const float luminance = 0.2126f * emitted.x + 0.7152f * emitted.y + 0.0722f * emitted.z;
    return std::min(std::max(luminance, 1e-20f), 1e20f);
}

} // namespace hipr
