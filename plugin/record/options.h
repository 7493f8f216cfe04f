/// @file options.h
/// The command line of hiprrecord.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugin/record/diagnostics.h"
#include "pxr/base/gf/vec4f.h"

namespace hipr::record {

/// An AOV, and the name of its layer in a file.
struct LayerName {
    std::string aov, name;
    bool half = false; ///< Layer::half
};

/// A file that a RenderProduct prim asks for.
struct ProductFile {
    std::string path;                          ///< may hold frame placeholders
    std::map<double, std::string> pathAtFrame; ///< where the name is animated
    std::vector<LayerName> layers;
};

struct Options {
    std::string scene;
    std::vector<std::string> outputs; ///< may hold frame placeholders

    std::string camera;                  ///< name, path, "auto", or empty for the default
    int width = 0, height = 0;           ///< 0: from the camera
    std::optional<PXR_NS::GfVec4f> crop; ///< the part to render; see dataWindowOf()
    std::vector<double> frames;          ///< empty: the stage's first
    std::vector<std::string> aovs{"color"};
    std::map<std::string, std::string> layerNames; ///< of AOVs whose layers are to be named otherwise
    bool half = false;                             ///< Layer::half of all AOVs
    std::vector<std::string> purposes{"default", "render"}; ///< always holds "default"
    std::vector<std::string> mask;
    int refineLevel = 0;

    int samples = 0;    ///< 0: the renderer's own
    double seconds = 0; ///< 0: no limit
    std::vector<std::pair<std::string, std::string>> settings;
    int threads = 0; ///< of the processor; 0: all
    std::string renderer = "HiPR", device;
    std::string view; ///< "VIEW" or "DISPLAY/VIEW"; empty for the default
    float exposure = 0;
    bool alpha = false;
    bool denoise = false; ///< pictures show the AOV denoised; those of products say for themselves

    std::string renderSettings; ///< RenderSettings prim; empty: the stage's own, where there are no outputs
    /// From render settings, never from the command line.
    std::vector<ProductFile> products;
    std::string conformPolicy; ///< aspectRatioConformPolicy; empty: adjustApertureWidth
    float pixelAspect = 1;     ///< width over height of a pixel
    std::vector<std::pair<std::string, std::string>> sceneSettings; ///< those that the renderer knows count
    bool aovsGiven = false, purposesGiven = false;                  ///< on the command line

    bool listSettings = false, listAovs = false, listCameras = false, listRenderers = false;
    std::string editsFile, editFramesFolder; ///< empty: none
    std::string dumpFile; ///< may hold a frame placeholder; empty: none; "-": standard output

    bool memory = false;
    std::string statsFile; ///< empty: none; "-": standard output
    Verbosity verbosity = Verbosity::Normal;

    /// The scene is only to be told of, not rendered.
    bool onlyDump() const {
        return outputs.empty() && products.empty() && editFramesFolder.empty() && !dumpFile.empty();
    }
    /// What to write is up to the products of the stage.
    bool asksForProducts() const {
        return outputs.empty() && products.empty() && dumpFile.empty() && editFramesFolder.empty();
    }
    bool onlyLists() const { return listSettings || listAovs || listCameras || listRenderers; }
};

/// Throws Failure with ExitUsage for a file of a kind that cannot be written.
void checkImageName(const std::string& output);

/// Throws Failure with ExitUsage where the files of several frames would have the same name.
void checkPlaceholder(const std::string& output, const std::vector<double>& frames);

/// Parses the command line. Returns nothing when help or the version was printed. Throws Failure with
/// ExitUsage.
std::optional<Options> parseOptions(int argc, const char* const* argv);

} // namespace hipr::record
