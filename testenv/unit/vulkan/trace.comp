#version 460
#extension GL_EXT_ray_query : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// One ray along +z from (0, 0, -1): distance of the nearest hit, or -1.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform accelerationStructureEXT scene;
layout(buffer_reference, scalar) buffer Floats { float v[]; };
layout(push_constant, scalar) uniform Push { uint64_t target; };
void main() {
    rayQueryEXT q;
    rayQueryInitializeEXT(q, scene, gl_RayFlagsOpaqueEXT, 0xff, vec3(0, 0, -1), 0.0, vec3(0, 0, 1), 1e30);
    while (rayQueryProceedEXT(q)) {
    }
    const bool hit = rayQueryGetIntersectionTypeEXT(q, true) != gl_RayQueryCommittedIntersectionNoneEXT;
    Floats(target).v[0] = hit ? rayQueryGetIntersectionTEXT(q, true) : -1.0;
}
