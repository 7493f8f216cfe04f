// Gaussian splats: records and maths of the splat pass, compiled as GLSL and as C++. The method: docs/higs.md.
#ifndef HIPR_SHARED_HIGS_H
#define HIPR_SHARED_HIGS_H
#include "language.h"
#include "trace.h"
HIPR_SHARED_BEGIN

// One pixel of the splat pass. Depth and ids are those of the splat at which the transmittance falls below 1/2, the
// median of what covers the pixel; where it stays above there is none: depth 0, ids -1, splat NO_SPLAT.
struct SplatPixel {
    vec3 color;          // premultiplied by alpha
    float transmittance; // 1 - alpha: what of the light behind comes through
    float depth;         // camera depth of the splat's centre, see CameraRecord
    int primId;
    int instanceId;
    uint splat;          // index in its cloud
};
HIPR_CONST uint NO_SPLAT = 0xffffffffu;

// Beyond this many standard deviations an opacity of 1 leaves less than 1/255.
HIPR_CONST float SPLAT_MAX_EXTENT = 3.33f;

// A cloud on the device.
struct SplatArrays {
    uint64_t positions;    // vec3[count], object space
    uint64_t shapes;       // uvec4[count]: quaternion xy, zw (snorm16), scale xy (half), scale z (half) and opacity (unorm16)
    uint64_t coefficients; // half[count][3 * (degree + 1)^2], or 0: colour 0.5
    uint count;
    uint degree;
    float scaleUnit;       // scales are in units of it
    uint pad;
};

HIPR_SHARED_END
#endif
