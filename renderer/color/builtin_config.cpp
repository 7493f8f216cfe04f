#include "renderer/color/color.h"

namespace hipr {

// Matrices follow from the chromaticities that the named standards give, all with white D65, so that no adaptation is
// involved; spaces with another white use OpenColorIO's own transforms. Aliases are the names that MaterialX and the
// ACES 1.3 configurations use.
const char* builtinColorConfig() {
    return R"(ocio_profile_version: 2
name: hipr
search_path: ""
strictparsing: true
roles:
  default: raw
  scene_linear: lin_rec709
  rendering: lin_rec709
  aces_interchange: ACES2065-1
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  sRGB:
    - !<View> {name: sRGB, colorspace: sRGB}
    - !<View> {name: ACES, colorspace: ACES 1.0 SDR Video}
    - !<View> {name: Raw, colorspace: raw}
colorspaces:
  - !<ColorSpace>
    name: lin_rec709
    aliases: [lin_srgb, linear, scene-linear Rec.709-sRGB, Linear Rec.709 (sRGB), Utility - Linear - sRGB, Utility - Linear - Rec.709]
    encoding: scene-linear
  - !<ColorSpace>
    name: raw
    aliases: [Raw, data, identity, Utility - Raw]
    isdata: true
    encoding: data
  - !<ColorSpace>
    name: sRGB
    aliases: [srgb_texture, srgb_tx, sRGB - Texture, Utility - sRGB - Texture, sRGB Encoded Rec.709 (sRGB)]
    encoding: sdr-video
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
  - !<ColorSpace>
    name: g22_rec709
    aliases: [Gamma 2.2 Rec.709 - Texture, Gamma 2.2 Encoded Rec.709]
    from_scene_reference: !<ExponentTransform> {value: 2.2, style: mirror, direction: inverse}
  - !<ColorSpace>
    name: g18_rec709
    aliases: [Gamma 1.8 Rec.709 - Texture, Gamma 1.8 Encoded Rec.709]
    from_scene_reference: !<ExponentTransform> {value: 1.8, style: mirror, direction: inverse}
  - !<ColorSpace>
    name: rec709_display
    aliases: [Camera Rec.709, Utility - Rec.709 - Camera]
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.2222222222222222, offset: 0.099, direction: inverse}
  - !<ColorSpace>
    name: lin_displayp3
    aliases: [lin_p3d65, Linear P3-D65, Utility - Linear - P3-D65]
    to_scene_reference: !<MatrixTransform> {matrix: [1.224940176, -0.2249401763, 0, 0, -0.04205695471, 1.042056955, 0, 0, -0.01963755459, -0.07863604555, 1.0982736, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: srgb_displayp3
    aliases: [srgb_p3d65, sRGB Encoded P3-D65]
    to_scene_reference: !<GroupTransform>
      children:
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}
        - !<MatrixTransform> {matrix: [1.224940176, -0.2249401763, 0, 0, -0.04205695471, 1.042056955, 0, 0, -0.01963755459, -0.07863604555, 1.0982736, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: lin_adobergb
    aliases: [Linear AdobeRGB, Utility - Linear - Adobe RGB]
    to_scene_reference: !<MatrixTransform> {matrix: [1.398355744, -0.398355744, 0, 0, 0, 1, 0, 0, 0, -0.04292898929, 1.042928989, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: adobergb
    aliases: [AdobeRGB, Utility - Adobe RGB - Display]
    to_scene_reference: !<GroupTransform>
      children:
        - !<ExponentTransform> {value: 2.19921875, style: mirror}
        - !<MatrixTransform> {matrix: [1.398355744, -0.398355744, 0, 0, 0, 1, 0, 0, 0, -0.04292898929, 1.042928989, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: lin_rec2020
    aliases: [Linear Rec.2020, Utility - Linear - Rec.2020]
    to_scene_reference: !<MatrixTransform> {matrix: [1.660491002, -0.5876411388, -0.07284986332, 0, -0.1245504745, 1.132899897, -0.008349422604, 0, -0.01815076335, -0.100578898, 1.118729661, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: ACEScg
    aliases: [acescg, lin_ap1, ACES - ACEScg]
    encoding: scene-linear
    to_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
  - !<ColorSpace>
    name: srgb_ap1
    aliases: [sRGB Encoded AP1]
    to_scene_reference: !<GroupTransform>
      children:
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
  - !<ColorSpace>
    name: g22_ap1
    aliases: [Gamma 2.2 AP1 - Texture, Gamma 2.2 Encoded AP1]
    to_scene_reference: !<GroupTransform>
      children:
        - !<ExponentTransform> {value: 2.2, style: mirror}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
  - !<ColorSpace>
    name: ACES2065-1
    aliases: [aces2065_1, lin_ap0, ACES - ACES2065-1]
    encoding: scene-linear
    to_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
        - !<MatrixTransform> {matrix: [0.4123907993, 0.3575843394, 0.1804807884, 0, 0.2126390059, 0.7151686788, 0.07219231536, 0, 0.01933081872, 0.1191947798, 0.9505321522, 0, 0, 0, 0, 1], direction: inverse}
  - !<ColorSpace>
    name: ACES 1.0 SDR Video
    encoding: sdr-video
    from_scene_reference: !<GroupTransform>
      children:
        - !<ColorSpaceTransform> {src: lin_rec709, dst: ACES2065-1}
        - !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
        - !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
)";
}

} // namespace hipr
