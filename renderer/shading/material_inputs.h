/// @file material_inputs.h
/// From MaterialDesc to the data kernels read: checking, texture look-up, flags.
#pragma once

#include <vector>

#include "renderer/api/material.h"
#include "renderer/shading/names.h"
#include "renderer/shading/textures.h"
#include "shaders/shared/material.h"

namespace hipr {

/// A checked input. `texture` is acquired from a TextureStore.
struct ResolvedInput {
    MaterialInput::Source kind = MaterialInput::Source::Constant;
    glm::vec4 constant{0.f};
    uint32_t texture = 0;
    gpu::InputNode node{}; ///< without the texture's record
};

struct ResolvedMaterial {
    MaterialModel model = MaterialModel::UsdPreviewSurface;
    std::vector<ResolvedInput> inputs; ///< by gpu::INPUT_*: gpu::PREVIEW_INPUT_COUNT or gpu::INPUT_COUNT
    bool specularWorkflow = false;
    bool thinWalled = false;
    gpu::MediumRecord interior{}, subsurface{};
    OpacityMode opacityMode = OpacityMode::Transparent;
};

/// Checks a description and acquires its textures. What is out of range is clamped; all of it is told in one
/// message, and so is what has no effect.
ResolvedMaterial resolveMaterial(const MaterialDesc& desc, NameTable& names, TextureStore& textures,
                                 const MessageSink& messages);

/// What kernels read of a material, without addresses.
struct MaterialRow {
    uint32_t flags = 0;
    gpu::MediumRecord interior{}, subsurface{};
    std::vector<glm::vec4> constants;
    std::vector<gpu::InputNode> nodes;
};

/// Valid after TextureStore::commit().
MaterialRow describeMaterial(const ResolvedMaterial& material, const TextureStore& textures);

bool isEmissive(const ResolvedMaterial& material);

/// About the luminance of what it emits, in nits, above 0 and finite if it is emissive: what textures and
/// primvars hold counts as 1.
float emittedLuminance(const ResolvedMaterial& material);

} // namespace hipr
