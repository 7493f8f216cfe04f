#include "renderer/scene/displacer.h"

#include <algorithm>

#include "shaders/shared/graph_value.h"

namespace hipr {

namespace {

std::shared_ptr<const HostTexture> textureOf(const MaterialInput& input, const HostTextures& textures) {
    const bool reads = input.source == MaterialInput::Source::Texture && !input.texture.path.empty();
    return reads ? textures(input.texture) : nullptr;
}

glm::vec4 channelOf(const glm::vec4& value, Channel channel) {
    return channel == Channel::Rgb ? value : glm::vec4(value[int(channel)]);
}

/// A primvar at a corner, as kernels read it: one component is spread, missing ones are (0, 0, 1).
bool primvarAt(const TriangleMesh& mesh, const std::string& name, uint32_t triangle, int corner,
               glm::vec4& value) {
    const auto found = std::find_if(mesh.primvars.begin(), mesh.primvars.end(),
                                    [&](const TrianglePrimvar& primvar) { return primvar.name == name; });
    if (found == mesh.primvars.end()) return false;
    size_t element = 0;
    switch (found->interpolation) {
    case Interpolation::Constant:
        break;
    case Interpolation::Uniform:
        element = triangle;
        break;
    case Interpolation::Vertex:
        element = mesh.triangles[triangle][corner];
        break;
    case Interpolation::FaceVarying:
        element = 3 * size_t(triangle) + size_t(corner);
        break;
    }
    const float* values = found->values.data() + element * found->components;
    value = found->components == 1 ? glm::vec4(glm::vec3(values[0]), 1.f) : glm::vec4(0.f, 0.f, 0.f, 1.f);
    for (uint32_t c = 0; found->components > 1 && c < std::min(found->components, 4u); ++c)
        value[int(c)] = values[c];
    return true;
}

} // namespace

Displacer::Displacer(const Displacement& displacement, const HostTextures& textures)
    : _displacement(displacement), _texture(textureOf(displacement.amount, textures)) {
    for (const MaterialInput& input : displacement.graph.reads)
        _graphTextures.push_back(textureOf(input, textures));
}

glm::vec4 Displacer::read(const MaterialInput& input, const HostTexture* texture, const TriangleMesh& mesh,
                          uint32_t triangle, int corner) const {
    const bool sampled = input.source == MaterialInput::Source::Texture;
    glm::vec4 value = sampled ? glm::vec4(input.texture.uvFallback, 0.f, 1.f) : input.constant;
    const std::string& name = sampled ? input.texture.uvPrimvar : input.primvar;
    if (!name.empty() && input.source != MaterialInput::Source::Constant)
        primvarAt(mesh, name, triangle, corner, value);
    if (sampled) value = texture ? texture->sample(input.texture, glm::vec2(value)) : input.texture.fallback;
    return channelOf(value, input.channel);
}

/// A step of a graph that reads the scene. World space is taken for object space.
glm::vec4 Displacer::step(const GraphNode& node, const glm::vec4& operand, const TriangleMesh& mesh,
                          const VertexFrames& frames, uint32_t triangle, int corner) const {
    const uint32_t vertex = mesh.triangles[triangle][corner];
    const glm::vec3 &n = frames.normals[vertex], &t = frames.tangents[vertex];
    switch (node.op) {
    case gpu::GRAPH_POSITION:
        return glm::vec4(mesh.positions[vertex], 1.f);
    case gpu::GRAPH_NORMAL:
        return glm::vec4(n, 0.f);
    case gpu::GRAPH_TANGENT:
        return glm::vec4(t, 0.f);
    case gpu::GRAPH_BITANGENT:
        return glm::vec4(glm::cross(n, t), 0.f);
    case gpu::GRAPH_TRANSFORM:
        return operand;
    default:
        break;
    }
    const MaterialInput& input = _displacement.graph.reads[node.immediate];
    const HostTexture* texture = _graphTextures[node.immediate].get();
    if (node.op == gpu::GRAPH_READ) return read(input, texture, mesh, triangle, corner);
    const glm::vec4 value =
        texture ? texture->sample(input.texture, glm::vec2(operand)) : input.texture.fallback;
    return channelOf(value, input.channel);
}

glm::vec4 Displacer::graphValue(uint32_t node, const TriangleMesh& mesh, const VertexFrames& frames,
                                uint32_t triangle, int corner) const {
    std::vector<glm::vec4> values(node + 1);
    for (uint32_t i = 0; i <= node; ++i) {
        const GraphNode& each = _displacement.graph.nodes[i];
        glm::vec4 in[3];
        for (int k = 0; k < 3; ++k)
            in[k] = each.operands[k].isConstant() ? each.operands[k].constant : values[each.operands[k].node];
        values[i] = each.op < gpu::GRAPH_FIRST_PURE
                        ? step(each, in[0], mesh, frames, triangle, corner)
                        : gpu::graphValue(each.op, each.immediate, in[0], in[1], in[2]);
    }
    return values[node];
}

glm::vec3 Displacer::at(const TriangleMesh& mesh, const VertexFrames& frames, uint32_t triangle,
                        int corner) const {
    const MaterialInput& amount = _displacement.amount;
    glm::vec4 value;
    if (amount.source == MaterialInput::Source::Graph) {
        value = channelOf(graphValue(amount.node, mesh, frames, triangle, corner), amount.channel);
    } else {
        value = read(amount, _texture.get(), mesh, triangle, corner);
    }
    return _displacement.vector ? glm::vec3(value) : glm::vec3(0.f, 0.f, value.x);
}

namespace {

std::shared_ptr<const TriangleMesh>
displacedShape(const TriangleMesh& mesh, const std::vector<std::shared_ptr<const Displacer>>& bySlot) {
    const VertexFrames frames = vertexFrames(mesh);
    return displace(mesh, frames, [&](uint32_t triangle, int corner) {
        const size_t slot = mesh.triangleSlot.empty() ? 0 : mesh.triangleSlot[triangle];
        const Displacer* displacer = slot < bySlot.size() ? bySlot[slot].get() : nullptr;
        return displacer ? displacer->at(mesh, frames, triangle, corner) : glm::vec3(0.f);
    });
}

} // namespace

std::shared_ptr<const TriangleMesh>
displacedMesh(const TriangleMesh& mesh, const std::vector<std::shared_ptr<const Displacer>>& bySlot) {
    const std::shared_ptr<const TriangleMesh> still = displacedShape(mesh, bySlot);
    if (mesh.motion.empty()) return still;
    std::vector<MeshShape> shapes;
    TriangleMesh shape = mesh;
    shape.motion.clear();
    for (const MeshKey& key : mesh.motion) {
        shape.positions = key.positions;
        shape.normals = key.normals;
        shapes.emplace_back(key.time, displacedShape(shape, bySlot));
    }
    return withMotion(*still, shapes);
}

} // namespace hipr
