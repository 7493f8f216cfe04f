#include "plugin/usdSplat/splatFileFormat.h"

#include <chrono>

#include "plugin/hdHipr/compatAssets.h"
#include "plugin/usdSplat/splatLayer.h"
#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/pathUtils.h"
#include "pxr/base/tf/registryManager.h"
#include "renderer/splats/splat_file.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

/// Posts how far a long reading is.
class Progress {
public:
    explicit Progress(std::string const& file) : _what("reading " + file) {}

    void operator()(double fraction) {
        const auto now = std::chrono::steady_clock::now();
        if (now - _last < interval && !(fraction >= 1.0 && _posted)) {
            return;
        }
        _last = now;
        _posted = fraction < 1.0;
        TF_STATUS(TfDiagnosticInfo(fraction), TF_DIAGNOSTIC_STATUS_TYPE, "%s", _what.c_str());
    }

private:
    static constexpr std::chrono::milliseconds interval{500};

    std::string _what;
    std::chrono::steady_clock::time_point _last = std::chrono::steady_clock::now();
    bool _posted = false;
};

hipr::SplatReadOptions readOptions(std::string const& file) {
    hipr::SplatReadOptions options;
    options.name = file;
    options.progress = Progress(TfGetBaseName(file));
    options.messages = [](hipr::Severity, std::string const& subject, std::string const& text) {
        TF_WARN("%s: %s", subject.c_str(), text.c_str());
    };
    return options;
}

/// Nothing, after a warning, when the layer's arguments make no sense.
UsdSplatUp upOf(SdfLayer const& layer, std::string const& file) {
    const SdfLayer::FileFormatArguments arguments = layer.GetFileFormatArguments();
    const auto given = arguments.find("up");
    if (given == arguments.end()) {
        return UsdSplatUp::Y;
    }
    const std::optional<UsdSplatUp> up = UsdSplatUpNamed(given->second);
    if (!up) {
        TF_WARN("%s: the argument up=%s is none of y, -y, z, -z; y is taken", file.c_str(),
                given->second.c_str());
    }
    return up.value_or(UsdSplatUp::Y);
}

/// That of what is shown of a layer's content; there is none of captures.
SdfFileFormatConstPtr textFormat() {
    return SdfFileFormat::FindById(TfToken("usda"));
}

} // namespace

TF_REGISTRY_FUNCTION(TfType) {
    SDF_DEFINE_FILE_FORMAT(UsdSplatFileFormat, SdfFileFormat);
}

UsdSplatFileFormat::UsdSplatFileFormat()
    : SdfFileFormat(TfToken("hiprSplat"), TfToken("1.0"), TfToken("usd"),
                    std::vector<std::string>{"ply", "spz"}) {}

bool UsdSplatFileFormat::CanRead(std::string const&) const {
    return true; // Read() tells what is wrong with a file, this could not
}

bool UsdSplatFileFormat::Read(SdfLayer* layer, std::string const& resolvedPath, bool metadataOnly) const {
    hipr::SplatCloud cloud;
    if (!metadataOnly) {
        const hdhipr::AssetBytes asset = hdhipr::openAsset(resolvedPath);
        try {
            if (!asset.data) {
                throw hipr::SplatFileError("cannot be opened");
            }
            cloud = hipr::readSplats({asset.data.get(), asset.size}, readOptions(resolvedPath));
        } catch (std::exception const& error) {
            TF_RUNTIME_ERROR("%s %s", resolvedPath.c_str(), error.what());
            return false;
        }
    }
    layer->TransferContent(UsdSplatMakeLayer(std::move(cloud), upOf(*layer, resolvedPath)));
    return true;
}

bool UsdSplatFileFormat::WriteToString(SdfLayer const& layer, std::string* text,
                                       std::string const& comment) const {
    const SdfFileFormatConstPtr usda = textFormat();
    return usda && usda->WriteToString(layer, text, comment);
}

bool UsdSplatFileFormat::WriteToStream(SdfSpecHandle const& spec, std::ostream& out, size_t indent) const {
    const SdfFileFormatConstPtr usda = textFormat();
    return usda && usda->WriteToStream(spec, out, indent);
}

PXR_NAMESPACE_CLOSE_SCOPE
