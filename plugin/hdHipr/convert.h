/// @file convert.h
/// Gf to glm. Gf matrices multiply row vectors, glm matrices column vectors; both store the translation in
/// elements 12..14, so the sixteen numbers in memory are the same.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/pxr.h"
#include "renderer/api/cull.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

inline glm::dmat4 toGlm(GfMatrix4d const& m) {
    return glm::make_mat4(m.GetArray());
}

inline glm::mat4x3 toGlmAffine(GfMatrix4d const& m) {
    return glm::mat4x3(glm::vec3(m[0][0], m[0][1], m[0][2]), glm::vec3(m[1][0], m[1][1], m[1][2]),
                       glm::vec3(m[2][0], m[2][1], m[2][2]), glm::vec3(m[3][0], m[3][1], m[3][2]));
}

inline glm::vec2 toGlm(GfVec2f const& v) {
    return glm::vec2(v[0], v[1]);
}
inline glm::vec3 toGlm(GfVec3f const& v) {
    return glm::vec3(v[0], v[1], v[2]);
}
inline glm::vec4 toGlm(GfVec4f const& v) {
    return glm::vec4(v[0], v[1], v[2], v[3]);
}

inline hipr::CullStyle toCullStyle(HdCullStyle style) {
    switch (style) {
    case HdCullStyleNothing:
        return hipr::CullStyle::Nothing;
    case HdCullStyleBack:
        return hipr::CullStyle::Back;
    case HdCullStyleFront:
        return hipr::CullStyle::Front;
    case HdCullStyleBackUnlessDoubleSided:
        return hipr::CullStyle::BackUnlessDoubleSided;
    case HdCullStyleFrontUnlessDoubleSided:
        return hipr::CullStyle::FrontUnlessDoubleSided;
    default:
        return hipr::CullStyle::Inherit;
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
