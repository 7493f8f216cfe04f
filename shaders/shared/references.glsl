// Buffer references to the tables of shaders/shared/*.h, declared once for all kernels: `GeometryRef(address).v[i]`.
// Every address is a 64-bit buffer device address; 0 means none and must not be read.
#ifndef HIPR_SHARED_REFERENCES_GLSL
#define HIPR_SHARED_REFERENCES_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : enable
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int16 : require
#extension GL_EXT_shader_16bit_storage : require
#extension GL_EXT_shader_8bit_storage : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/language.h"
#include "shared/scene.h"
#include "shared/material.h"
#include "shared/graph.h"
#include "shared/light.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FloatRef { float v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vec2Ref { vec2 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vec3Ref { vec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vec4Ref { vec4 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer UintRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Uvec2Ref { uvec2 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Uvec3Ref { uvec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 2) readonly buffer Uint16Ref { uint16_t v[]; };

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SceneRef { SceneRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer GeometryRef { GeometryRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PrimvarRef { PrimvarRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer InstanceRef { InstanceRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer MaterialRef { MaterialRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer InputNodeRef { InputNode v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer GraphStepRef { GraphStep v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer TextureRef { TextureRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer LightRef { LightRecord v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer LightNodeRef { LightNode v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ShapingRef { ShapingRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ShadowRef { ShadowRecord v; };
#endif
