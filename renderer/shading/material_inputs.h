/// @file material_inputs.h
/// From MaterialDesc to the data kernels read: checking, texture look-up, flags.
#pragma once

#include <array>
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
    std::array<ResolvedInput, gpu::INPUT_COUNT> inputs;
    bool specularWorkflow = false;
    OpacityMode opacityMode = OpacityMode::Transparent;
};

/// Checks a description and acquires its textures. What is out of range is clamped; all of it is told in one
/// message.
ResolvedMaterial resolveMaterial(const MaterialDesc& desc, NameTable& names, TextureStore& textures,
                                 const MessageSink& messages);

/// The record (inputNodes is left to the caller) and its nodes. Valid after TextureStore::commit().
gpu::MaterialRecord describeMaterial(const ResolvedMaterial& material, const TextureStore& textures,
                                     std::vector<gpu::InputNode>& nodes);

bool isEmissive(const ResolvedMaterial& material);

} // namespace hipr
