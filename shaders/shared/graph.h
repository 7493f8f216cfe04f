// Programs that compute inputs of materials: the operations of a register machine on vec4 values. graph_value.h does
// them, as GLSL and C++. A number is the same in all four components; a colour's or vector's missing components have no
// meaning.
#ifndef HIPR_SHARED_GRAPH_H
#define HIPR_SHARED_GRAPH_H
#include "language.h"
HIPR_SHARED_BEGIN

// What reads the scene: these need a hit. `immediate` is the number of an InputNode where not said otherwise.
HIPR_CONST uint GRAPH_POSITION = 0u;       // immediate: GRAPH_OBJECT or GRAPH_WORLD
HIPR_CONST uint GRAPH_NORMAL = 1u;         // the interpolated one, on the front side; immediate as above
HIPR_CONST uint GRAPH_READ = 2u;           // the texture at the InputNode's own coordinates, or its primvar
HIPR_CONST uint GRAPH_TANGENT = 3u;        // in world space, along s of the InputNode's primvar
HIPR_CONST uint GRAPH_BITANGENT = 4u;      // the same along t
HIPR_CONST uint GRAPH_TEXTURE = 5u;        // the texture at a.xy, through the InputNode's transform
HIPR_CONST uint GRAPH_TRANSFORM = 6u;      // a; immediate: GRAPH_OBJECT or GRAPH_WORLD to go to, and GRAPH_AS_*
HIPR_CONST uint GRAPH_FIRST_WITH_OPERANDS = 5u;
HIPR_CONST uint GRAPH_FIRST_PURE = 7u;
// What depends on operands alone.
HIPR_CONST uint GRAPH_MOVE = 7u;
HIPR_CONST uint GRAPH_ADD = 8u;
HIPR_CONST uint GRAPH_SUBTRACT = 9u;
HIPR_CONST uint GRAPH_MULTIPLY = 10u;
HIPR_CONST uint GRAPH_DIVIDE = 11u;        // by 0: 0
HIPR_CONST uint GRAPH_MODULO = 12u;        // takes the sign of b; by 0: 0
HIPR_CONST uint GRAPH_POWER = 13u;         // of negative numbers: 0 unless b is whole
HIPR_CONST uint GRAPH_MIN = 14u;
HIPR_CONST uint GRAPH_MAX = 15u;
HIPR_CONST uint GRAPH_MIX = 16u;           // from a to b by c
HIPR_CONST uint GRAPH_SMOOTHSTEP = 17u;    // of a between b and c
HIPR_CONST uint GRAPH_ABS = 18u;
HIPR_CONST uint GRAPH_FLOOR = 19u;
HIPR_CONST uint GRAPH_SIGN = 20u;
HIPR_CONST uint GRAPH_SIN = 21u;           // radians
HIPR_CONST uint GRAPH_COS = 22u;
HIPR_CONST uint GRAPH_ASIN = 23u;          // outside of -1..1: as at its end
HIPR_CONST uint GRAPH_ATAN2 = 24u;         // of a / b; 0 where both are 0
HIPR_CONST uint GRAPH_SQRT = 25u;          // of negative numbers: 0
HIPR_CONST uint GRAPH_LN = 26u;            // of what is not positive: 0
HIPR_CONST uint GRAPH_EXP = 27u;
HIPR_CONST uint GRAPH_GREATER = 28u;       // a > b: 1, else 0
HIPR_CONST uint GRAPH_EQUAL = 29u;
HIPR_CONST uint GRAPH_SELECT = 30u;        // a where c is not 0, else b
HIPR_CONST uint GRAPH_DOT = 31u;           // of the first `immediate` components
HIPR_CONST uint GRAPH_CROSS = 32u;
HIPR_CONST uint GRAPH_SWIZZLE = 33u;       // immediate: four digits of 4 bits, 0..3 components of a, 4: 0, 5: 1
HIPR_CONST uint GRAPH_COMBINE = 34u;       // (a.x, b.x, c.x, 1)
HIPR_CONST uint GRAPH_WITH_W = 35u;        // (a.xyz, b.x)
HIPR_CONST uint GRAPH_ROTATE = 36u;        // a by -b.x degrees around the axis c
HIPR_CONST uint GRAPH_RGB_TO_HSV = 37u;    // hue in turns; w stays
HIPR_CONST uint GRAPH_HSV_TO_RGB = 38u;
HIPR_CONST uint GRAPH_NOISE = 39u;         // at a; b: octaves, lacunarity, diminish; immediate: dimensions, in all below
HIPR_CONST uint GRAPH_CELL = 40u;          // one number
HIPR_CONST uint GRAPH_CELL3 = 41u;         // three
HIPR_CONST uint GRAPH_WORLEY = 42u;        // at a; b.x: jitter; with GRAPH_NEAREST the nearest point
HIPR_CONST uint GRAPH_OP_COUNT = 43u;

HIPR_CONST uint GRAPH_OBJECT = 0u;
HIPR_CONST uint GRAPH_WORLD = 1u;
HIPR_CONST uint GRAPH_AS_POINT = 0u;
HIPR_CONST uint GRAPH_AS_VECTOR = 2u;
HIPR_CONST uint GRAPH_AS_NORMAL = 4u;
HIPR_CONST uint GRAPH_NEAREST = 8u;

// One step of a program. A material's steps that its opacity needs come first.
struct GraphStep {
    uint code;       // op | register for the result << 8 | INPUT_* it sets << 16; GRAPH_NOWHERE for none
    uint operands;   // a | b << 16: a register, or GRAPH_CONSTANT + a place among the material's constants
    uint operand;    // c
    uint immediate;
};
HIPR_CONST uint GRAPH_NOWHERE = 0xffu;
HIPR_CONST uint GRAPH_CONSTANT = 0x8000u;
HIPR_CONST uint GRAPH_REGISTERS = 12u;

HIPR_SHARED_END
#endif
