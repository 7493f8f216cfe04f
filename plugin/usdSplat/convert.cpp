/// @file convert.cpp
/// hiprconvert: captures of splats to USD, and splats to .ply.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "plugin/hdHipr/splatCloud.h"
#include "plugin/record/progress.h"
#include "plugin/usdSplat/splatAttributes.h"
#include "plugin/usdSplat/splatLayer.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/errorMark.h"
#include "pxr/base/tf/pathUtils.h"
#include "pxr/usd/usd/primRange.h"
#include "pxr/usd/usd/stage.h"
#include "renderer/splats/splat_file.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using hipr::SplatCloud;

struct Options {
    std::string input, output, prim;
    std::string up = "y";
    double time = 0.0;
};

const char* const footer = R"(
examples:
  hiprconvert robot.ply robot.usdc             a capture as USD, ready to be referenced
  hiprconvert --up -y room.ply room.usda       a capture that stands on its head, set upright; as text
  hiprconvert scene.usda robot.ply --prim /World/Robot
                                               a prim's splats, in the prim's own space, back to a capture

USD files hold one prim, /Splats, of the type ParticleField3DGaussianSplat that OpenUSD 26.03 defines.)";

[[noreturn]] void fail(std::string const& file, std::string const& why) {
    throw std::runtime_error(file + " " + why);
}

bool isCapture(std::string const& file) {
    const std::string extension = TfStringToLower(TfGetExtension(file));
    return extension == "ply" || extension == "spz";
}

bool isPly(std::string const& file) {
    return TfStringToLower(TfGetExtension(file)) == "ply";
}

/// The errors of USD since the mark was set, as one text.
std::string errorsSince(TfErrorMark& mark) {
    std::string text;
    for (TfError const& error : mark) {
        text += (text.empty() ? "" : "; ") + error.GetCommentary();
    }
    mark.Clear();
    return text;
}

SplatCloud readCapture(std::string const& file) {
    hipr::record::Progress progress(stderr, isatty(STDERR_FILENO));
    progress.begin("reading " + file);
    const auto start = std::chrono::steady_clock::now();
    hipr::SplatReadOptions options;
    options.name = file;
    options.messages = [](hipr::Severity, std::string const& subject, std::string const& text) {
        std::fprintf(stderr, "hiprconvert: warning: %s: %s\n", subject.c_str(), text.c_str());
    };
    options.progress = [&](double fraction) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        progress.update({fraction, 0, passed.count()});
    };
    try {
        SplatCloud cloud = hipr::readSplatFile(file, options);
        progress.end();
        return cloud;
    } catch (hipr::SplatFileError const& error) {
        progress.end();
        fail(file, error.what());
    }
}

/// The prim of that path, or the only one with splats.
UsdPrim findPrim(UsdStageRefPtr const& stage, Options const& options) {
    std::vector<UsdPrim> found;
    for (UsdPrim const& prim : stage->Traverse()) {
        const bool splats = prim.GetTypeName() == "ParticleField3DGaussianSplat";
        if (splats && (options.prim.empty() || prim.GetPath().GetString() == options.prim)) {
            found.push_back(prim);
        }
    }
    if (found.empty()) {
        fail(options.input, "has no splats" + (options.prim.empty() ? "" : " at " + options.prim));
    }
    if (found.size() > 1) {
        fail(options.input, "has " + std::to_string(found.size()) +
                                " prims with splats; choose one: --prim " +
                                found.front().GetPath().GetString());
    }
    return found.front();
}

std::shared_ptr<const SplatCloud> readStage(Options const& options) {
    TfErrorMark errors;
    const UsdStageRefPtr stage = UsdStage::Open(options.input);
    if (!stage) {
        fail(options.input, "cannot be opened: " + errorsSince(errors));
    }
    const UsdPrim prim = findPrim(stage, options);
    return hdhipr::readSplatCloud(prim.GetPath().GetString(), [&](TfToken const& name) {
        VtValue value;
        if (const UsdAttribute attribute = UsdSplatAttribute(prim, name)) {
            attribute.Get(&value, UsdTimeCode(options.time));
        }
        return value;
    });
}

void writeCapture(SplatCloud const& cloud, std::string const& file) {
    std::ofstream out(file, std::ios::binary);
    writePly(cloud, out);
    out.close();
    if (!out) {
        fail(file, "cannot be written");
    }
}

void writeUsd(SplatCloud&& cloud, UsdSplatUp up, std::string const& file) {
    TfErrorMark errors;
    if (!UsdSplatMakeLayer(std::move(cloud), up)->Export(file)) {
        fail(file, "cannot be written: " + errorsSince(errors));
    }
}

void convert(Options const& options) {
    const std::optional<UsdSplatUp> up = UsdSplatUpNamed(options.up);
    if (!up) {
        fail("--up", options.up + " is none of y, -y, z, -z");
    }
    size_t count = 0;
    if (isPly(options.output)) {
        if (*up != UsdSplatUp::Y) {
            fail("--up", "is for USD: a .ply cannot say where up is");
        }
        const auto cloud = isCapture(options.input)
                               ? std::make_shared<const SplatCloud>(readCapture(options.input))
                               : readStage(options);
        count = cloud->size();
        writeCapture(*cloud, options.output);
    } else if (isCapture(options.input)) {
        SplatCloud cloud = readCapture(options.input);
        count = cloud.size();
        writeUsd(std::move(cloud), *up, options.output);
    } else {
        fail(options.input, "is no capture (.ply, .spz), and " + options.output + " is none (.ply)");
    }
    std::printf("wrote %s (%zu splats)\n", options.output.c_str(), count);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Converts captures of Gaussian splats (3DGS .ply, .spz) to USD, and splats to .ply.",
                 "hiprconvert");
    app.add_option("input", options.input, "a .ply, a .spz, or a stage with splats")->required();
    app.add_option("output", options.output, "a .usdc, .usda or .usd, or a .ply")->required();
    app.add_option("--up", options.up,
                   "the axis that points up in the capture, and becomes Y: y, -y, z or -z [y]");
    app.add_option("--prim", options.prim, "of a stage with several clouds of splats, the one to take");
    app.add_option("--time", options.time, "the frame to take of a stage [0]");
    app.footer(footer);
    try {
        app.parse(argc, argv);
        convert(options);
        return 0;
    } catch (CLI::ParseError const& error) {
        return app.exit(error);
    } catch (std::exception const& error) {
        std::fprintf(stderr, "hiprconvert: error: %s\n", error.what());
        return 1;
    }
}
