#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// out[i] = factor * in[i] + i for i < count
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) buffer Floats { float v[]; };
layout(push_constant, scalar) uniform Push {
    uint64_t source, target;
    uint count;
    float factor;
};
void main() {
    const uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64 + gl_GlobalInvocationID.x;
    if (i < count) Floats(target).v[i] = factor * Floats(source).v[i] + float(i);
}
