/// @file material_inputs.h
/// From MaterialDesc to the data kernels read: checking, texture look-up, flags.
#pragma once

#include <vector>

#include "renderer/api/material.h"
#include "renderer/shading/names.h"
#include "renderer/shading/textures.h"
#include "shaders/shared/graph.h"
#include "shaders/shared/material.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// A checked input.
struct ResolvedInput {
    MaterialInput::Source kind = MaterialInput::Source::Constant;
    glm::vec4 constant{0.f};
    glm::vec4 scale{1.f}, bias{0.f}; ///< of a texture
};

/// What a program reads.
struct ResolvedRead {
    bool textured = false;
    uint32_t texture = 0;  ///< acquired from a TextureStore
    gpu::InputNode node{}; ///< without the texture's record
};

struct ResolvedMaterial {
    MaterialModel model = MaterialModel::UsdPreviewSurface;
    std::vector<ResolvedInput> inputs; ///< by gpu::INPUT_*: gpu::PREVIEW_INPUT_COUNT or gpu::INPUT_COUNT
    std::vector<ResolvedRead> reads;
    std::vector<gpu::GraphStep> steps;
    uint32_t presenceSteps = 0;
    std::vector<glm::vec4> stepConstants;
    uint32_t opacityRead = gpu::NO_INDEX; ///< which read opacity is, if it is a texture
    bool specularWorkflow = false;
    bool thinWalled = false;
    int priority = 0; ///< of what it is inside
    bool subsurfaceTravels = false;
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
    std::vector<gpu::GraphStep> steps;
    uint32_t presenceSteps = 0;
    int priority = 0;
};

/// Valid after TextureStore::commit().
MaterialRow describeMaterial(const ResolvedMaterial& material, const TextureStore& textures);

} // namespace hipr
