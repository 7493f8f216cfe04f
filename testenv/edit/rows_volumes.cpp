// Volumes: their fields, looks, places and instances. The scene gets one first, so that the other rows need
// not draw it.
#include <filesystem>
#include <set>

#include <unistd.h>

#include "testenv/common/vdb_kit.h"
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const std::string fog = "/World/Fog", density = fog + "/density", mist = "/World/Mist",
                  copies = "/World/Copies";

std::string fileOf(const char* name, double thickness) {
    const auto folder = std::filesystem::temp_directory_path() / "hipr_edit_volumes";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / (std::string(name) + ".vdb")).string();
    VdbGrid smoke, heat;
    smoke.lo = glm::ivec3(-8);
    smoke.value = [=](glm::ivec3 p) { return thickness * (1.0 + 0.05 * p.x); };
    heat = smoke;
    heat.name = "heat";
    heat.value = [](glm::ivec3 p) { return 1.0 + 0.1 * p.y; };
    static std::set<std::string> done;
    if (done.insert(path).second) { // another shard may be reading it
        const std::string written = path + "." + std::to_string(getpid());
        writeVdb(written, {smoke, heat});
        std::filesystem::rename(written, path);
    }
    return path;
}

std::string thickDensity() {
    return R"(
        def OpenVDBAsset "density" {
            asset filePath = @)" +
           fileOf("thick", 2) + R"(@
            token fieldName = "density"
        }
)";
}

/// Two volumes in front of the scene, and a material that they may be bound to.
Edit someFog() {
    return usda(R"(over "World" {
    def Material "Medium" {
        token outputs:volume.connect = </World/Medium/Volume.outputs:out>
        def Shader "Volume" {
            uniform token info:id = "ND_volume"
            token inputs:vdf.connect = </World/Medium/Vdf.outputs:out>
            token outputs:out
        }
        def Shader "Vdf" {
            uniform token info:id = "ND_anisotropic_vdf"
            vector3f inputs:absorption = (0.5, 1, 2)
            vector3f inputs:scattering = (0.5, 0.5, 0.5)
            token outputs:out
        }
    }
    def Volume "Fog" {
        rel field:density = </World/Fog/density>
        float primvars:hipr:volume:density = 1.5
        double3 xformOp:translate = (1.5, 1.5, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
)" + thickDensity() +
                R"(    }
    def Volume "Mist" {
        rel field:density = </World/Mist/density>
        double3 xformOp:translate = (2.4, 1.8, 0.8)
        uniform token[] xformOpOrder = ["xformOp:translate"]
)" + thickDensity() +
                R"(    }
})");
}

/// Instances of a volume that lies below their instancer.
Edit someCopies() {
    return usda(R"(over "World" {
    def PointInstancer "Copies" {
        rel prototypes = </World/Copies/Fog>
        int[] protoIndices = [0, 0]
        point3f[] positions = [(1, 1.5, 1), (2.2, 1.9, 1.2)]
        float3[] scales = [(0.7, 0.7, 0.7), (0.5, 0.6, 0.8)]
        def Volume "Fog" {
            rel field:density = </World/Copies/Fog/density>
)" + thickDensity() +
                R"(        }
    }
})");
}

Row row(const char* name, Edit edit) {
    return {name, std::move(edit), someFog()};
}

} // namespace

Rows volumeRows() {
    return {
        {"VolumeAdd", someFog()},
        row("VolumeFile", in(density, "asset filePath = @" + fileOf("thin", 0.5) + "@")),
        row("VolumeFileMissing", in(density, "asset filePath = @/nowhere.vdb@")),
        row("VolumeGrid", in(density, R"(token fieldName = "heat")")),
        row("VolumeGridMissing", in(density, R"(token fieldName = "nothing")")),
        row("VolumeFieldsSwitch",
            in(fog, "rel field:density = </World/Mist/density>\nrel field:emission = </World/Fog/density>")),
        row("VolumeFieldRemove", removePrim(density)),
        row("VolumeDensity", in(fog, "float primvars:hipr:volume:density = 4")),
        row("VolumeAlbedo", in(fog, "color3f primvars:hipr:volume:albedo = (0.9, 0.3, 0.1)")),
        row("VolumeAnisotropy", in(fog, "float primvars:hipr:volume:anisotropy = 0.7")),
        row("VolumeMove", in(fog, "double3 xformOp:translate = (1.7, 1.6, 1)")),
        row("VolumeHide", in(fog, R"(token visibility = "invisible")")),
        row("VolumePurpose", in(fog, R"(uniform token purpose = "guide")")),
        row("VolumeRemove", removePrim(fog)),
        row("VolumeDeactivate", activate(mist, false)),
        row("VolumeRename", rename(fog, "/World/Haze")),
        row("VolumeBind", in(fog, "rel material:binding = </World/Medium>")),
        {"VolumeMedium", in("/World/Medium/Vdf", "vector3f inputs:scattering = (2, 1, 0.5)"),
         all({someFog(), in(fog, "rel material:binding = </World/Medium>")})},
        {"VolumeInstances", someCopies()},
        {"VolumeInstancesMove", in(copies, "point3f[] positions = [(1, 1.5, 1), (1.9, 1.6, 1.2)]"),
         someCopies()},
        {"VolumeInstancesFewer", in(copies, R"(int[] protoIndices = [0]
point3f[] positions = [(1, 1.5, 1)]
float3[] scales = [(0.7, 0.7, 0.7)])"),
         someCopies()},
        {"VolumeInstancesFile", in(copies + "/Fog/density", "asset filePath = @" + fileOf("thin", 0.5) + "@"),
         someCopies()},
        {"VolumeMotion",
         in(fog, "double3 xformOp:translate.timeSamples = {\n4: (1.2, 1.5, 1),\n6: (1.9, 1.6, 1),\n}"),
         all({someFog(), time(5), in("/Camera", "double shutter:open = -0.5\ndouble shutter:close = 0.5")})},
        row("VolumeBesideAMesh", in("/World/Geo/Cube", "double3 xformOp:translate = (1.5, 1.5, 1)")),
    };
}

} // namespace hipr::test
