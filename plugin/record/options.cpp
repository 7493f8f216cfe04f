#include "plugin/record/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plugin/record/cryptomatte.h"
#include "plugin/record/dataWindow.h"
#include "plugin/record/failure.h"
#include "plugin/record/frames.h"
#include "plugin/record/images.h"

namespace hipr::record {

namespace {

const char* const description =
    "Records a USD stage to image files with a Hydra renderer. Needs no window, no display and no OpenGL.";

const char* const epilogue = R"(Examples:
  hiprrecord scene.usda -o picture.png                      the default camera, or the whole stage
  hiprrecord scene.usdz -o picture.exr -o picture.png --size 1920x1080 --samples 256
  hiprrecord shot.usd -o shot.####.exr --frames 1001:1100 --camera shotCam
  hiprrecord shot.usd -o layers.exr --aovs color,normal,cameraDepth,primId
  hiprrecord shot.usd -o quick.jpg --time 10 --set hipr:maxDepth=2
  hiprrecord shot.usd --frames 1001:1100                    the files that the stage's render settings name
  hiprrecord scene.usda -o picture.png --edits edits.json   a picture after each edit of the live scene

EXR files hold every AOV: color as R G B A, others as layers <aov>.X/Y/Z, .R/G/B, .Z or .V (32-bit float); ids
as <aov>.I (unsigned int; where nothing is seen, -1 reads 4294967295); CryptoObject, CryptoMaterial and
CryptoAsset as three layers each, with a manifest. Values are scene-linear. PNG and JPEG files
show color through the view transform.

Exit codes: 0 done, 1 usage (also an edit that cannot be done), 2 stage cannot be read, 3 no such camera, 4 output
cannot be written, 5 rendering failed, 130 interrupted (what was there has been written).)";

struct RawOptions {
    std::string size, crop, frames, complexity = "low", aovs, purposes;
    std::vector<std::string> settings, masks;
    bool quiet = false, verbose = false;
};

/// Commas in braces stay: those of a light path expression.
std::vector<std::string> splitCommas(const std::string& text) {
    std::vector<std::string> parts;
    std::string part;
    int braces = 0;
    for (const char c : text + ",") {
        braces += (c == '{') - (c == '}');
        if ((c != ',' && c != ' ') || (c == ',' && braces > 0)) {
            part += c;
        } else if (!part.empty()) {
            if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
            part.clear();
        }
    }
    return parts;
}

/// AOVs, each by its name or as LAYER=AOV.
void parseAovs(const std::string& text, Options& options) {
    options.aovs.clear();
    for (const std::string& part : splitCommas(text)) {
        const size_t equals = std::min(part.find('='), part.find(':')); // expressions may hold a '=' too
        const bool named = equals != std::string::npos && part[equals] == '=';
        const std::string aov = named ? part.substr(equals + 1) : part;
        for (const std::string& expanded : expandedAov(aov)) {
            options.aovs.push_back(expanded);
            if (named) options.layerNames[expanded] = part.substr(0, equals) + expanded.substr(aov.size());
        }
    }
}

/// The picture is that without noise; the noisy one stays beside it.
void showDenoised(Options& options) {
    const auto has = [&](const char* aov) {
        return std::find(options.aovs.begin(), options.aovs.end(), aov) != options.aovs.end();
    };
    if (!has("color")) throw Failure(ExitUsage, "--denoise shows the AOV color, which --aovs leaves out");
    if (!has("denoised")) options.aovs.insert(options.aovs.begin(), "denoised");
    options.layerNames["denoised"] = "color";
    options.layerNames.emplace("color", "noisy");
}

void parseSize(const std::string& text, Options& options) {
    int end = 0;
    const int count = std::sscanf(text.c_str(), "%5dx%5d%n", &options.width, &options.height, &end);
    const bool both = count == 2 && size_t(end) == text.size();
    const bool one = count == 1 && text.find_first_not_of("0123456789") == std::string::npos;
    const bool positive = options.width > 0 && (one || options.height > 0);
    if (!(both || one) || !positive || options.width > 65536 || options.height > 65536)
        throw Failure(ExitUsage,
                      "--size: '" + text + "' is neither WIDTHxHEIGHT nor WIDTH, 1 to 65536 pixels");
}

/// The names and numbers usdview uses: 1.0 to 1.4 in steps of a tenth, each one more subdivision level.
int parseComplexity(const std::string& text) {
    static const char* const names[] = {"low", "medium", "high", "veryhigh"};
    for (int level = 0; level < 4; ++level)
        if (text == names[level]) return level;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(number >= 1.0 && number <= 1.8))
        throw Failure(ExitUsage,
                      "--complexity: '" + text + "' is none of low, medium, high, veryhigh, 1.0 to 1.8");
    return int(std::lround((number - 1.0) * 10.0));
}

std::vector<std::string> parsePurposes(const std::string& text) {
    std::vector<std::string> purposes = splitCommas(text);
    for (const std::string& purpose : purposes)
        if (purpose != "default" && purpose != "render" && purpose != "proxy" && purpose != "guide")
            throw Failure(ExitUsage,
                          "--purposes: '" + purpose + "' is none of default, render, proxy, guide");
    if (std::find(purposes.begin(), purposes.end(), "default") == purposes.end())
        purposes.insert(purposes.begin(), "default");
    return purposes;
}

std::pair<std::string, std::string> parseSetting(const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw Failure(ExitUsage, "--set: '" + text + "' is not of the form key=value");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void addSceneOptions(CLI::App& app, Options& options, RawOptions& raw) {
    app.add_option("scene", options.scene,
                   "The stage: .usd, .usda, .usdc or .usdz, or a capture: .ply or .spz")
        ->type_name("SCENE");
    app.add_option(
           "--camera,-c", options.camera,
           "Camera by name or prim path; 'auto' frames the whole stage. Default: the camera of the stage's "
           "render settings, else its first camera, else auto")
        ->type_name("NAME")
        ->group("Scene");
    app.add_option("--frames,-f", raw.frames,
                   "Frames: 7, 1:10, 1:10x2, or several with commas. Default: the first frame")
        ->type_name("RANGE")
        ->group("Scene");
    app.add_option("--complexity", raw.complexity,
                   "Subdivision: low, medium, high, veryhigh, or 1.0 to 1.8, one level per tenth [low]")
        ->type_name("LEVEL")
        ->group("Scene");
    app.add_option("--purposes", raw.purposes,
                   "Purposes to show besides default: render, proxy, guide; an empty list shows default "
                   "alone [render]")
        ->type_name("LIST")
        ->group("Scene");
    app.add_option("--mask", raw.masks, "Open only these prims, with their ancestors and descendants")
        ->type_name("PRIMPATH,...")
        ->allow_extra_args(false)
        ->group("Scene");
    app.add_flag("--list-cameras", options.listCameras, "Print the cameras of the stage")->group("Scene");
}

void addPictureOptions(CLI::App& app, Options& options, RawOptions& raw) {
    app.add_option(
           "-o,--output", options.outputs,
           "Image file: .exr, .png or .jpg; may be given several times. #### stands for the frame number")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->group("Picture");
    app.add_option("--size,-s", raw.size,
                   "WIDTHxHEIGHT in pixels, or WIDTH with the camera's aspect ratio [960]")
        ->type_name("SIZE")
        ->group("Picture");
    app.add_option("--crop", raw.crop,
                   "Render only this part: XMIN,YMIN,XMAX,YMAX, where 0,0 is the bottom left of the picture "
                   "and 1,1 its top right; numbers beyond are overscan. EXR files say where it belongs")
        ->type_name("WINDOW")
        ->group("Picture");
    app.add_option(
           "--aovs", raw.aovs,
           "AOVs to render, e.g. color,depth,normal,primId,primvars:st [color]. LAYER=AOV names the layer in "
           "EXR files: key=lpe:C.*<L.'key'>")
        ->type_name("LIST")
        ->group("Picture");
    app.add_flag(
           "--denoise", options.denoise,
           "Write the picture without noise, by Open Image Denoise; EXR files hold the noisy one as the "
           "layer noisy")
        ->group("Picture");
    app.add_flag("--half", options.half, "Write the colours of EXR files with 16 bits")->group("Picture");
    app.add_option(
           "--render-settings", options.renderSettings,
           "RenderSettings prim that names camera, size, purposes, settings and, without -o, the files "
           "to write. Default without -o: that of the stage")
        ->type_name("PRIMPATH")
        ->group("Picture");
    app.add_flag("--list-aovs", options.listAovs, "Print the AOVs the renderer has")->group("Picture");
    app.add_option("--view", options.view,
                   "View transform of PNG and JPEG: VIEW or DISPLAY/VIEW of the OCIO config")
        ->type_name("NAME")
        ->group("Picture");
    app.add_option("--exposure", options.exposure, "Brightens PNG and JPEG by this many stops [0]")
        ->type_name("STOPS")
        ->check(CLI::Range(-100.f, 100.f))
        ->group("Picture");
    app.add_flag("--alpha", options.alpha, "Keep the background of PNG files transparent instead of black")
        ->group("Picture");
}

void addRendererOptions(CLI::App& app, Options& options, RawOptions& raw) {
    app.add_option("--samples,-n", options.samples, "Samples per pixel. Default: the renderer's own")
        ->type_name("N")
        ->check(CLI::Range(1, 1 << 20))
        ->group("Rendering");
    app.add_option("--time,-t", options.seconds,
                   "Stop each frame after this many seconds, or earlier when --samples are done")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber)
        ->group("Rendering");
    app.add_option("--threads", options.threads, "Threads of the processor to use at most [all]")
        ->type_name("N")
        ->check(CLI::Range(1, 4096))
        ->group("Rendering");
    app.add_option("--set", raw.settings, "A setting of the renderer; may be given several times")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group("Rendering");
    app.add_flag("--list-settings", options.listSettings, "Print the settings of the renderer")
        ->group("Rendering");
    app.add_option("--device", options.device, "Device of the HiPR renderer, by index or part of its name")
        ->type_name("DEVICE")
        ->group("Rendering");
    app.add_option("--renderer", options.renderer,
                   "Another Hydra renderer, by display name or plugin id [HiPR]")
        ->type_name("NAME")
        ->group("Rendering");
    app.add_flag("--list-renderers", options.listRenderers, "Print the renderers that are installed")
        ->group("Rendering");
}

void addEditOptions(CLI::App& app, Options& options) {
    app.add_option("--edits", options.editsFile,
                   "Apply the edits of this JSON script one after the other while rendering, with a picture "
                   "NAME.<number>.<edit>.EXT of each; number 0 is the scene before any edit")
        ->type_name("FILE")
        ->group("Edits");
    app.add_option("--edit-frames", options.editFramesFolder,
                   "Write the picture after every batch of work into this folder, and frames.jsonl, which "
                   "tells of each")
        ->type_name("FOLDER")
        ->group("Edits");
}

void addReportOptions(CLI::App& app, Options& options, RawOptions& raw) {
    app.add_flag("--memory", options.memory, "Print the renderer's memory by kind after each frame")
        ->group("Reports");
    app.add_option("--stats", options.statsFile,
                   "Write times, samples and renderer statistics as JSON; - prints them")
        ->type_name("FILE")
        ->group("Reports");
    app.add_option("--dump-scene", options.dumpFile,
                   "Write what the renderer holds of the scene as text, one fact per line; - prints it. "
                   "Without -o nothing is rendered")
        ->type_name("FILE")
        ->group("Reports");
    app.add_flag("-q,--quiet", raw.quiet, "Print errors only")->group("Reports");
    app.add_flag("-v,--verbose", raw.verbose, "Print status messages too")->group("Reports");
}

void checkOutputs(const Options& options) {
    const bool hasColor = std::find(options.aovs.begin(), options.aovs.end(), "color") != options.aovs.end();
    for (const std::string& output : options.outputs) {
        checkImageName(output);
        if (imageKind(output) != "exr" && !hasColor)
            throw Failure(ExitUsage, "'" + output + "' shows the AOV color, which --aovs leaves out");
        checkPlaceholder(output, options.frames);
    }
    if (!options.dumpFile.empty() && options.dumpFile != "-")
        checkPlaceholder(options.dumpFile, options.frames);
    const bool edits = !options.editsFile.empty() || !options.editFramesFolder.empty();
    if (edits && options.frames.size() > 1)
        throw Failure(ExitUsage, "--edits and --edit-frames render one frame, not several");
    if (!options.editFramesFolder.empty() && !hasColor)
        throw Failure(ExitUsage, "--edit-frames shows the AOV color, which --aovs leaves out");
    if (!options.editFramesFolder.empty() && options.renderer != "HiPR")
        throw Failure(ExitUsage, "--edit-frames needs the renderer HiPR");
}

void interpret(const RawOptions& raw, Options& options) {
    if (!raw.size.empty()) parseSize(raw.size, options);
    if (!raw.crop.empty()) options.crop = parseDataWindow(raw.crop);
    if (!raw.frames.empty()) options.frames = parseFrames(raw.frames);
    if (!raw.aovs.empty()) parseAovs(raw.aovs, options);
    if (options.aovs.empty()) throw Failure(ExitUsage, "--aovs: no AOV given");
    if (options.denoise) showDenoised(options);
    for (const std::string& text : raw.masks)
        for (const std::string& path : splitCommas(text))
            options.mask.push_back(path);
    options.refineLevel = parseComplexity(raw.complexity);
    for (const std::string& text : raw.settings)
        options.settings.push_back(parseSetting(text));
    if (raw.quiet) options.verbosity = Verbosity::Quiet;
    if (raw.verbose) options.verbosity = Verbosity::Verbose;
    if (!options.device.empty() && options.renderer != "HiPR")
        throw Failure(ExitUsage, "--device only means something to the renderer HiPR");
    const bool needsScene = options.listCameras || !options.onlyLists();
    if (needsScene && options.scene.empty()) throw Failure(ExitUsage, "no scene given (see --help)");
    if (!options.onlyLists()) checkOutputs(options);
}

} // namespace

void checkImageName(const std::string& output) {
    if (imageKind(output).empty())
        throw Failure(ExitUsage, "'" + output + "': image files end in .exr, .png or .jpg");
}

void checkPlaceholder(const std::string& output, const std::vector<double>& frames) {
    const FramePattern pattern(output);
    if (frames.size() > 1 && !pattern.hasPlaceholder())
        throw Failure(ExitUsage,
                      "'" + output + "' needs a frame placeholder such as #### for several frames");
    const bool fractional =
        std::any_of(frames.begin(), frames.end(), [](double frame) { return frame != std::round(frame); });
    if (frames.size() > 1 && fractional && !pattern.hasFraction())
        throw Failure(ExitUsage,
                      "'" + output + "' needs a placeholder such as ####.## for fractional frames");
}

std::optional<Options> parseOptions(int argc, const char* const* argv) {
    Options options;
    RawOptions raw;
    CLI::App app(description, "hiprrecord");
    app.footer(epilogue);
    app.set_version_flag("--version", HIPR_VERSION);
    addSceneOptions(app, options, raw);
    addPictureOptions(app, options, raw);
    addRendererOptions(app, options, raw);
    addEditOptions(app, options);
    addReportOptions(app, options, raw);
    try {
        app.parse(argc, argv);
        options.purposesGiven = app.count("--purposes") > 0;
        if (options.purposesGiven) options.purposes = parsePurposes(raw.purposes);
        options.aovsGiven = app.count("--aovs") > 0;
        interpret(raw, options);
    } catch (const CLI::Success& request) {
        app.exit(request);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw Failure(ExitUsage, std::string(error.what()) + " (see --help)");
    } catch (const std::invalid_argument& error) {
        throw Failure(ExitUsage, error.what());
    }
    return options;
}

} // namespace hipr::record
