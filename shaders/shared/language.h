// Lets one header define structs for C++ (GLM types) and GLSL (scalar block layout, so both sides agree byte by byte).
#ifndef HIPR_SHARED_LANGUAGE_H
#define HIPR_SHARED_LANGUAGE_H
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define HIPR_SHARED_BEGIN namespace hipr::gpu { using glm::vec2; using glm::vec3; using glm::vec4; using glm::uvec2; using glm::uvec3; using glm::uvec4; using glm::ivec2; using glm::ivec4; using glm::mat4x3; using glm::mat4; using uint = uint32_t;
#define HIPR_SHARED_END }
#define HIPR_CONST constexpr
#define HIPR_PRECISE
#define HIPR_OUT(type) type&
#define HIPR_INLINE inline
#else
#define HIPR_SHARED_BEGIN
#define HIPR_SHARED_END
#define HIPR_CONST const
#define HIPR_PRECISE precise
#define HIPR_OUT(type) out type
#define HIPR_INLINE
#endif
#endif
