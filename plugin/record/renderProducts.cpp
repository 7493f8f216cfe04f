#include "plugin/record/renderProducts.h"

#include <algorithm>
#include <cmath>

#include "plugin/record/cryptomatte.h"
#include "plugin/record/diagnostics.h"
#include "plugin/record/failure.h"
#include "plugin/record/stage.h"
#include "pxr/base/gf/vec2i.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/usd/usdRender/product.h"
#include "pxr/usd/usdRender/settings.h"
#include "pxr/usd/usdRender/var.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

/// Products that are seen by one camera in one size.
struct ProductGroup {
    std::string camera; ///< prim path, empty: none is named
    int width = 0, height = 0;
    std::string conformPolicy;
    GfVec4f dataWindow = {0, 0, 1, 1};
    float pixelAspect = 1;
    bool motionBlur = true, depthOfField = true;
    std::vector<ProductFile> files;
    bool sameView(const ProductGroup& o) const {
        return camera == o.camera && width == o.width && height == o.height &&
               conformPolicy == o.conformPolicy && dataWindow == o.dataWindow &&
               pixelAspect == o.pixelAspect && motionBlur == o.motionBlur && depthOfField == o.depthOfField;
    }
};

std::string textOf(const UsdAttribute& attribute, UsdTimeCode time = UsdTimeCode::Default()) {
    TfToken token;
    if (attribute && attribute.Get(&token, time)) return token.GetString();
    std::string text;
    if (attribute) attribute.Get(&text, time);
    return text;
}

SdfPathVector targetsOf(const UsdRelationship& relationship) {
    SdfPathVector targets;
    if (relationship) relationship.GetForwardedTargets(&targets);
    return targets;
}

/// A product says what its settings do not say already.
UsdAttribute stronger(const UsdAttribute& ofProduct, const UsdAttribute& ofSettings) {
    return ofProduct && ofProduct.HasAuthoredValue() ? ofProduct : ofSettings;
}

/// A switch that some version of the schema has.
bool isOn(const char* name, const UsdRenderSettingsBase& product, const UsdRenderSettings& settings) {
    const TfToken attribute(name);
    bool on = false;
    stronger(product.GetPrim().GetAttribute(attribute), settings.GetPrim().GetAttribute(attribute)).Get(&on);
    return on;
}

/// The AOV that a RenderVar means. RenderMan's name of the picture is understood as well.
std::string aovOf(const UsdRenderVar& var) {
    const std::string name = textOf(var.GetSourceNameAttr()), type = textOf(var.GetSourceTypeAttr());
    if (type == "primvar") return "primvars:" + name;
    if (type == "lpe") return TfStringStartsWith(name, "lpe:") ? name : "lpe:" + name;
    return name == "Ci" ? "color" : name;
}

/// Whether an EXR has 16 bits of a var: of a type like color3h, half4 or half.
bool half(const UsdRenderVar& var) {
    const std::string type = textOf(var.GetDataTypeAttr());
    return TfStringStartsWith(type, "half") || TfStringEndsWith(type, "3h") || TfStringEndsWith(type, "4h");
}

/// Reads products of one RenderSettings prim.
class Reader {
public:
    Reader(const UsdStageRefPtr& stage, const UsdRenderSettings& settings, const std::vector<double>& frames)
        : _stage(stage), _settings(settings), _frames(frames) {}

    std::vector<ProductGroup> groups() const;
    /// What a product or the settings themselves look at.
    ProductGroup view(const UsdRenderSettingsBase& product) const;

private:
    bool rendered(const UsdRenderProduct& product) const;
    ProductFile file(const UsdRenderProduct& product) const;
    std::vector<LayerName> layers(const UsdRenderProduct& product) const;

    UsdStageRefPtr _stage;
    UsdRenderSettings _settings;
    const std::vector<double>& _frames;
};

bool Reader::rendered(const UsdRenderProduct& product) const {
    const std::string path = product.GetPath().GetString(), type = textOf(product.GetProductTypeAttr());
    if (type.empty() || type == "raster") return true;
    printWarning("product " + path + " is of type '" + type + "', which is not supported; it is left out");
    return false;
}

ProductGroup Reader::view(const UsdRenderSettingsBase& product) const {
    ProductGroup group;
    GfVec2i resolution(0);
    stronger(product.GetResolutionAttr(), _settings.GetResolutionAttr()).Get(&resolution);
    group.width = resolution[0];
    group.height = resolution[1];
    SdfPathVector cameras = targetsOf(product.GetCameraRel());
    if (cameras.empty()) cameras = targetsOf(_settings.GetCameraRel());
    if (!cameras.empty()) group.camera = cameras.front().GetString();
    group.conformPolicy = textOf(
        stronger(product.GetAspectRatioConformPolicyAttr(), _settings.GetAspectRatioConformPolicyAttr()));

    const std::string path = product.GetPath().GetString();
    stronger(product.GetDataWindowNDCAttr(), _settings.GetDataWindowNDCAttr()).Get(&group.dataWindow);
    stronger(product.GetPixelAspectRatioAttr(), _settings.GetPixelAspectRatioAttr()).Get(&group.pixelAspect);
    if (!(group.pixelAspect > 0) || !std::isfinite(group.pixelAspect)) {
        printWarning(path + ": pixelAspectRatio is no positive number; pixels are square");
        group.pixelAspect = 1;
    }
    group.motionBlur = !isOn("disableMotionBlur", product, _settings) && // before 23.05 by another name
                       !isOn("instantaneousShutter", product, _settings);
    group.depthOfField = !isOn("disableDepthOfField", product, _settings);
    return group;
}

std::vector<LayerName> Reader::layers(const UsdRenderProduct& product) const {
    std::vector<LayerName> layers;
    for (const SdfPath& target : targetsOf(product.GetOrderedVarsRel())) {
        const UsdRenderVar var(_stage->GetPrimAtPath(target));
        if (!var)
            throw Failure(ExitUsage,
                          product.GetPath().GetString() + ": no RenderVar at " + target.GetString());
        const std::string aov = aovOf(var);
        if (aov.empty()) throw Failure(ExitUsage, "RenderVar " + target.GetString() + " has no sourceName");
        const std::string name = textOf(var.GetPrim().GetAttribute(TfToken("driver:parameters:aov:name")));
        const std::vector<std::string> aovs = expandedAov(aov);
        for (const std::string& part : aovs) // whose numbers follow the name
            layers.push_back({part, (name.empty() ? aov : name) + part.substr(aov.size()), half(var)});
    }
    if (layers.empty()) layers.push_back({"color", "color"});
    return layers;
}

ProductFile Reader::file(const UsdRenderProduct& product) const {
    ProductFile file;
    const UsdAttribute name = product.GetProductNameAttr();
    file.path = textOf(name);
    if (name && name.GetNumTimeSamples() > 0)
        for (const double frame : _frames)
            file.pathAtFrame[frame] = file.path = textOf(name, frame);
    if (file.path.empty())
        throw Failure(ExitUsage,
                      "product " + product.GetPath().GetString() + " has no productName: that is its file");
    file.layers = layers(product);
    return file;
}

std::vector<ProductGroup> Reader::groups() const {
    std::vector<ProductGroup> groups;
    for (const SdfPath& target : targetsOf(_settings.GetProductsRel())) {
        const UsdRenderProduct product(_stage->GetPrimAtPath(target));
        if (!product)
            throw Failure(ExitUsage,
                          _settings.GetPath().GetString() + ": no RenderProduct at " + target.GetString());
        if (!rendered(product)) continue;
        const ProductGroup seen = view(product);
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const ProductGroup& other) { return other.sameView(seen); });
        if (group == groups.end()) group = groups.insert(groups.end(), seen);
        group->files.push_back(file(product));
    }
    return groups;
}

UsdRenderSettings findSettings(const UsdStageRefPtr& stage, const std::string& path) {
    if (path.empty()) return UsdRenderSettings::GetStageRenderSettings(stage);
    if (!SdfPath::IsValidPathString(path)) return UsdRenderSettings();
    return UsdRenderSettings(stage->GetPrimAtPath(SdfPath(path)));
}

/// includedPurposes, if they are authored.
std::vector<std::string> purposesOf(const UsdRenderSettings& settings) {
    std::vector<std::string> names;
    VtArray<TfToken> purposes;
    const UsdAttribute included = settings.GetIncludedPurposesAttr();
    if (included.HasAuthoredValue()) included.Get(&purposes);
    for (const TfToken& purpose : purposes)
        names.push_back(purpose.GetString());
    return names;
}

/// Attributes that the schema does not have: settings of renderers, this one's or others'.
std::vector<std::pair<std::string, std::string>> rendererSettings(const UsdRenderSettings& settings) {
    std::vector<std::pair<std::string, std::string>> texts;
    const TfTokenVector known = UsdRenderSettings::GetSchemaAttributeNames();
    for (const UsdAttribute& attribute : settings.GetPrim().GetAuthoredAttributes()) {
        VtValue value;
        const bool own = std::find(known.begin(), known.end(), attribute.GetName()) != known.end();
        if (!own && attribute.Get(&value))
            texts.emplace_back(attribute.GetName().GetString(), TfStringify(value));
    }
    return texts;
}

void look(Options& options, const ProductGroup& view) {
    if (options.camera.empty()) options.camera = view.camera;
    if (options.width == 0) {
        options.width = view.width;
        options.height = view.height;
    }
    if (!options.crop && view.dataWindow != GfVec4f(0, 0, 1, 1)) options.crop = view.dataWindow;
    options.conformPolicy = view.conformPolicy;
    options.pixelAspect = view.pixelAspect;
    if (!view.motionBlur) options.sceneSettings.emplace_back("enableMotionBlur", "0");
    if (!view.depthOfField) options.sceneSettings.emplace_back("enableDepthOfField", "0");
}

/// One recording writes these files.
void produce(Options& options, const ProductGroup& group) {
    look(options, group);
    options.products = group.files;
    options.aovs.clear();
    for (const ProductFile& file : group.files) {
        checkImageName(file.path);
        if (file.pathAtFrame.empty()) checkPlaceholder(file.path, options.frames);
        for (const LayerName& layer : file.layers)
            if (std::find(options.aovs.begin(), options.aovs.end(), layer.aov) == options.aovs.end())
                options.aovs.push_back(layer.aov);
    }
}

void checkProducts(const Options& options, const std::vector<ProductGroup>& groups, const std::string& path) {
    if (groups.empty())
        throw Failure(ExitUsage, "the render settings " + path + " have no product: give -o FILE");
    if (options.aovsGiven)
        throw Failure(ExitUsage, "--aovs: products name their AOVs themselves; give -o FILE as well");
    if (groups.size() > 1 && (!options.statsFile.empty() || !options.editsFile.empty()))
        throw Failure(ExitUsage, "--stats and --edits are for one camera and size, and the products of " +
                                     path + " have several; give -o FILE");
}

} // namespace

Recordings recordingsOf(const Options& options) {
    if (options.renderSettings.empty() && !options.asksForProducts()) return {{options}, {}};
    Recordings recordings{{}, openStage(options.scene, {})};
    const UsdRenderSettings settings = findSettings(recordings.stage, options.renderSettings);
    if (!settings)
        throw Failure(ExitUsage,
                      options.renderSettings.empty()
                          ? "no output: give -o FILE (see --help); the stage names no render settings"
                          : "no RenderSettings prim '" + options.renderSettings + "' on the stage");
    Options common = options;
    if (common.frames.empty()) common.frames = {defaultFrame(recordings.stage)};
    common.sceneSettings = rendererSettings(settings);
    const std::vector<std::string> purposes = purposesOf(settings);
    if (!purposes.empty() && !options.purposesGiven) common.purposes = purposes;

    const Reader reader(recordings.stage, settings, common.frames);
    if (!options.asksForProducts()) {
        look(common, reader.view(settings));
        recordings.options = {common};
        return recordings;
    }
    const std::vector<ProductGroup> groups = reader.groups();
    checkProducts(options, groups, settings.GetPath().GetString());
    for (const ProductGroup& group : groups)
        produce(recordings.options.emplace_back(common), group);
    return recordings;
}

} // namespace hipr::record
