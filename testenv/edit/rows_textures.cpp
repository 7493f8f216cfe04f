// Texture files and how they are read.
#include "testenv/edit/edits.h"

namespace hipr::test {

Rows textureRows() {
    const std::string color = "/World/Looks/Textured/Color", mask = "/World/Looks/Cutout/Mask";
    const std::string folder = "../../scenes/textures/";
    const auto file = [&](const std::string& name) { return "asset inputs:file = @" + folder + name + "@"; };
    return {
        {"TextureFile", in(color, file("tile.1002.png"))},
        {"TextureFileUsedElsewhere", in(color, file("tile.1001.png"))},
        {"TextureFileMissing", in(color, file("nowhere.png"))},
        {"TextureFileFound", in(color, file("ramp.png")), in(color, file("nowhere.png"))},
        {"TextureFileEmpty", in(color, "asset inputs:file = @@")},
        {"TextureFileUdim", in(color, file("tile.<UDIM>.png"))},
        {"TextureFileFromUdim", in(color, file("ramp.png")), in(color, file("tile.<UDIM>.png"))},
        {"TextureFallback", in(color, "float4 inputs:fallback = (0.9, 0.1, 0.1, 1)"),
         in(color, file("nowhere.png"))},
        {"TextureWrapS", in(color, R"(token inputs:wrapS = "black")")},
        {"TextureWrapT", in(color, R"(token inputs:wrapT = "mirror")")},
        {"TextureWrapRemoved", removeProperty(color + ".inputs:wrapS")},
        {"TextureColorSpace", in(color, R"(token inputs:sourceColorSpace = "raw")")},
        {"TextureColorSpaceBack", in(color, R"(token inputs:sourceColorSpace = "sRGB")"),
         in(color, R"(token inputs:sourceColorSpace = "raw")")},
        {"TextureColorSpaceSame", in(color, R"(token inputs:sourceColorSpace = "sRGB")"), {}, false},
        {"TextureColorSpaceOfMask", in(mask, R"(token inputs:sourceColorSpace = "sRGB")")},
        {"TextureScale", in(color, "float4 inputs:scale = (0.5, 1, 0.2, 1)")},
        {"TextureBias", in(color, "float4 inputs:bias = (0.3, 0, 0.3, 0)")},
        {"TextureScaleOfMask", in(mask, "float4 inputs:scale = (0.3, 0.3, 0.3, 1)")},
        {"TextureMaterialRemoved",
         removePrim("/World/Looks/Textured"),
         {},
         true,
         "",
         "it does not look again for a material that was missing"},
        {"TextureSharedThenDropped", in("/World/Looks/Reader/Surface", "float inputs:roughness = 0.8"),
         all({in("/World/Looks/Reader/Surface",
                 "color3f inputs:diffuseColor.connect = </World/Looks/Textured/Color.outputs:rgb>"),
              in(color, file("tile.1002.png"))}),
         false},
    };
}

} // namespace hipr::test
