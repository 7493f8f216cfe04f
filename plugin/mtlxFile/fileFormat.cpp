#include "plugin/mtlxFile/fileFormat.h"

#include "plugin/hdHipr/compatAssets.h"
#include "plugin/mtlxFile/layer.h"
#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/registryManager.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

std::optional<std::string> contentOf(std::string const& path) {
    const hdhipr::AssetBytes asset = hdhipr::openAsset(hdhipr::resolveAsset(path));
    if (!asset.data) {
        return std::nullopt;
    }
    return std::string(reinterpret_cast<char const*>(asset.data.get()), asset.size);
}

void read(SdfLayer* layer, std::string const& text, std::string const& path) {
    hipr::mtlx::Surroundings surroundings;
    surroundings.read = contentOf;
    surroundings.anchor = hdhipr::anchorAsset;
    surroundings.message = [](std::string const& message) { TF_WARN("%s", message.c_str()); };
    layer->TransferContent(hdhipr::mtlxLayer(hipr::mtlx::Document(text, path, surroundings)));
}

/// That of what is shown of a layer's content.
SdfFileFormatConstPtr textFormat() {
    return SdfFileFormat::FindById(TfToken("usda"));
}

} // namespace

TF_REGISTRY_FUNCTION(TfType) {
    SDF_DEFINE_FILE_FORMAT(HiprMtlxFileFormat, SdfFileFormat);
}

HiprMtlxFileFormat::HiprMtlxFileFormat()
    : SdfFileFormat(TfToken("hiprMtlx"), TfToken("1.0"), TfToken("usd"), std::string("mtlx")) {}

bool HiprMtlxFileFormat::CanRead(std::string const&) const {
    return true; // Read() tells what is wrong with a file, this could not
}

bool HiprMtlxFileFormat::Read(SdfLayer* layer, std::string const& resolvedPath, bool) const {
    const std::optional<std::string> text = contentOf(resolvedPath);
    if (!text) {
        TF_RUNTIME_ERROR("%s cannot be opened", resolvedPath.c_str());
        return false;
    }
    read(layer, *text, resolvedPath);
    return true;
}

bool HiprMtlxFileFormat::ReadFromString(SdfLayer* layer, std::string const& text) const {
    read(layer, text, layer->GetIdentifier());
    return true;
}

bool HiprMtlxFileFormat::WriteToString(SdfLayer const& layer, std::string* text,
                                       std::string const& comment) const {
    const SdfFileFormatConstPtr usda = textFormat();
    return usda && usda->WriteToString(layer, text, comment);
}

bool HiprMtlxFileFormat::WriteToStream(SdfSpecHandle const& spec, std::ostream& out, size_t indent) const {
    const SdfFileFormatConstPtr usda = textFormat();
    return usda && usda->WriteToStream(spec, out, indent);
}

PXR_NAMESPACE_CLOSE_SCOPE
