/// @file displacer.h
/// What a material's displacement says at the corners of a mesh.
#pragma once

#include <memory>
#include <vector>

#include "renderer/api/material.h"
#include "renderer/api/mesh.h"
#include "renderer/geometry/displace.h"
#include "renderer/shading/host_texture.h"

namespace hipr {

/// Gives the texels of a texture.
using HostTextures = std::function<std::shared_ptr<const HostTexture>(const TextureDesc&)>;

/// One material's displacement with its textures. Immutable.
class Displacer {
public:
    Displacer(const Displacement& displacement, const HostTextures& textures);

    const Displacement& description() const { return _displacement; }

    /// Along tangent, bitangent and normal of the vertex.
    glm::vec3 at(const TriangleMesh& mesh, const VertexFrames& frames, uint32_t triangle, int corner) const;

private:
    glm::vec4 read(const MaterialInput& input, const HostTexture* texture, const TriangleMesh& mesh,
                   uint32_t triangle, int corner) const;
    glm::vec4 graphValue(uint32_t node, const TriangleMesh& mesh, const VertexFrames& frames,
                         uint32_t triangle, int corner) const;
    glm::vec4 step(const GraphNode& node, const glm::vec4& operand, const TriangleMesh& mesh,
                   const VertexFrames& frames, uint32_t triangle, int corner) const;

    Displacement _displacement;
    std::shared_ptr<const HostTexture> _texture;                    ///< of the amount
    std::vector<std::shared_ptr<const HostTexture>> _graphTextures; ///< of the graph's reads
};

/// The mesh as the materials of its slots displace it. Slots beyond the list and null ones move nothing.
std::shared_ptr<const TriangleMesh>
displacedMesh(const TriangleMesh& mesh, const std::vector<std::shared_ptr<const Displacer>>& bySlot);

} // namespace hipr
