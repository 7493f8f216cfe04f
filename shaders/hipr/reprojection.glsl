// What the kernels of reprojection share.
#ifndef HIPR_HIPR_REPROJECTION_GLSL
#define HIPR_HIPR_REPROJECTION_GLSL
#include "shared/references.glsl"
#include "shared/reproject.h"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ReprojectionRef { ReprojectionRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CameraRef { CameraRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FilmRef { FilmPixel v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OldPictureRef { OldPixel v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SeenRef { SeenPoint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SourceRef { CarriedSource v[]; };

layout(push_constant, scalar) uniform Push { ReprojectionPush push; };

CarriedPixel carried(ReprojectionRecord r, uint pixel) {
    return carryPixel(CameraRef(r.after).v, SeenRef(r.seen).v[pixel], pixel % r.width, pixel / r.width, r.width,
                      r.height);
}
#endif
