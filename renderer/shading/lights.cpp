#include "renderer/shading/lights.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/constants.hpp>

#include "renderer/shading/dome.h"
#include "renderer/shading/light_choice.h"
#include "renderer/shading/light_shape.h"
#include "renderer/shading/light_shaping.h"
#include "renderer/shading/light_tree.h"

namespace hipr {

using gpu::LightRecord;

/// Up to so many lights are chosen by power, which an edit of one of them disturbs least (see
/// light_choice.h).
constexpr size_t FewLights = 16;

struct LightTable::Impl {
    struct Light {
        std::string name;
        LightRecord record;
        std::optional<uint32_t> texture;
        uint32_t links; ///< LightNode::links
        LightShaping shaping;
        std::optional<gpu::ShadowRecord> shadow;
    };
    /// What the table knows of a texture's pixels.
    struct Picture {
        glm::vec3 mean{1.f};
        DomeTable dome;
        Buffer table;
    };

    /// What rebuild() fills: lights in the order of the table, and what some have beside.
    struct Tables {
        std::vector<LightRecord> lights;
        std::vector<double> powers;
        std::vector<uint32_t> links; ///< LightNode::links
        std::vector<gpu::ShapingRecord> shapings;
        std::vector<gpu::ShadowRecord> shadows;
    };

    Impl(Device& device, TextureStore& textures, CategoryTable& categories)
        : device(device), textures(textures), categories(categories), profiles(device, textures.assets()) {}

    Device& device;
    TextureStore& textures;
    CategoryTable& categories;
    ProfileStore profiles;
    std::map<LightId, Light> lights; ///< those that emit, as far as their description tells
    std::map<uint32_t, Picture> pictures;
    bool changed = true, shadowsShown = true;
    uint32_t textureVersion = 0;
    double sceneRadius = -1.0;
    std::vector<MeshLight> meshes;
    uint32_t instanceCount = 0;
    uint32_t areaLights = 0, thinLights = 0, infiniteLights = 0; ///< meshes are before the infinite ones
    Buffer records, cumulative, shapings, shadows, instanceLights;
    Buffer nodes;
    uint32_t nodeCount = 0;
    float treeChance = 0.f;
    bool hasShadows = false;

    void forget(LightId id);
    const Picture& picture(uint32_t texture);
    void dropPictures();
    std::vector<Light*> inOrder();
    uint32_t& groupOf(const LightRecord& record);
    bool bindTexture(Light& light, LightRecord& record, glm::vec3& mean);
    double shape(const LightShaping& shaping, const std::string& name, LightRecord& record,
                 std::vector<gpu::ShapingRecord>& table);
    void addShadow(gpu::ShadowRecord shadow, LightRecord& record, std::vector<gpu::ShadowRecord>& table);
    template <class Record>
    void uploadParts(const std::vector<Record>& parts, uint64_t LightRecord::*address,
                     std::vector<LightRecord>& table, Buffer& buffer);
    size_t inTree() const { return areaLights + thinLights + meshes.size(); }
    void addMeshes(Tables& tables);
    float govern(const SurfaceLight& light, LightRecord& record, std::vector<gpu::ShadowRecord>& table);
    void rebuild();
    void growTree(Tables& tables);
    std::vector<float> spreadChances(Tables& tables);
};

void LightTable::Impl::forget(LightId id) {
    const auto known = lights.find(id);
    if (known == lights.end()) return;
    if (known->second.texture) textures.release(*known->second.texture);
    lights.erase(known);
    changed = true;
}

const LightTable::Impl::Picture& LightTable::Impl::picture(uint32_t texture) {
    const auto known = pictures.find(texture);
    if (known != pictures.end()) return known->second;
    Picture& picture = pictures[texture];
    if (const Image* image = textures.image(texture)) {
        picture.dome = buildDomeTable(*image);
        picture.mean = picture.dome.mean;
        picture.table =
            device.createFrom(picture.dome.values.data(), picture.dome.values.size(), "light tables");
        textures.releasePixels(texture);
    }
    return picture;
}

void LightTable::Impl::dropPictures() {
    for (auto it = pictures.begin(); it != pictures.end();) {
        const bool used = std::any_of(lights.begin(), lights.end(),
                                      [&](const auto& entry) { return entry.second.texture == it->first; });
        it = used ? std::next(it) : pictures.erase(it);
    }
}

/// By name: which light a random number chooses must not depend on the edits that led here. Ids do.
std::vector<LightTable::Impl::Light*> LightTable::Impl::inOrder() {
    std::vector<Light*> order;
    for (auto& [id, light] : lights)
        order.push_back(&light);
    std::stable_sort(order.begin(), order.end(),
                     [](const Light* a, const Light* b) { return a->name < b->name; });
    return order;
}

/// The number of lights of this one's group.
uint32_t& LightTable::Impl::groupOf(const LightRecord& record) {
    if (record.kind == gpu::LIGHT_THIN) return thinLights;
    return record.kind == gpu::LIGHT_DOME || record.kind == gpu::LIGHT_DISTANT ? infiniteLights : areaLights;
}

/// Points the record at its texture. Returns false when the picture is black.
bool LightTable::Impl::bindTexture(Light& light, LightRecord& record, glm::vec3& mean) {
    if (!light.texture) return true;
    const Picture& known = picture(*light.texture);
    if (!known.table) return true; // unreadable, which the texture store has told: a constant colour
    mean = known.mean;
    record.texture = textures.range(*light.texture).first;
    if (record.kind == gpu::LIGHT_DOME) {
        record.distribution = known.table.address();
        record.distributionWidth = known.dome.width;
        record.distributionHeight = known.dome.height;
    }
    return !known.dome.values.empty();
}

/// Adds a light's shaping to the table; `record` refers to it by its place there, counted from 1, until
/// uploadParts(). Returns the share of the light's power that is left.
double LightTable::Impl::shape(const LightShaping& shaping, const std::string& name, LightRecord& record,
                               std::vector<gpu::ShapingRecord>& table) {
    if (record.kind == gpu::LIGHT_DOME || !isShaped(shaping)) return 1.0;
    const std::string& file = shaping.iesFile;
    const ProfileStore::Entry* profile = file.empty() ? nullptr : profiles.find(file, name);
    table.push_back(describeShaping(shaping, profile));
    record.shaping = table.size();
    const bool flat = record.kind == gpu::LIGHT_RECT || record.kind == gpu::LIGHT_DISK;
    return shapedShare(table.back(), profile, flat);
}

/// Adds a light's shadows to the table; `record` refers to them as to its shaping.
void LightTable::Impl::addShadow(gpu::ShadowRecord shadow, LightRecord& record,
                                 std::vector<gpu::ShadowRecord>& table) {
    if (record.kind == gpu::LIGHT_MESH) shadow.instance = record.instance;
    table.push_back(shadow);
    record.shadow = table.size();
}

/// Uploads what some lights have beside their records, and turns their numbers of it into addresses.
template <class Record>
void LightTable::Impl::uploadParts(const std::vector<Record>& parts, uint64_t LightRecord::*address,
                                   std::vector<LightRecord>& table, Buffer& buffer) {
    buffer = device.createFrom(parts.data(), parts.size(), "light tables");
    for (LightRecord& record : table)
        if (record.*address) record.*address = buffer.address() + (record.*address - 1) * sizeof(Record);
}

void LightTable::Impl::rebuild() {
    Tables tables;
    areaLights = thinLights = infiniteLights = 0;
    const std::vector<Light*> order = inOrder();
    for (uint32_t* count : {&areaLights, &thinLights, &infiniteLights}) {
        if (count == &infiniteLights) addMeshes(tables);
        for (Light* light : order) {
            glm::vec3 mean(1.f);
            LightRecord record = light->record;
            if (&groupOf(record) != count || !bindTexture(*light, record, mean)) continue;
            const double share = shape(light->shaping, light->name, record, tables.shapings);
            if (!(share > 0.0)) continue;
            if (shadowsShown && light->shadow) addShadow(*light->shadow, record, tables.shadows);
            tables.lights.push_back(record);
            tables.powers.push_back(share * lightPower(record, mean, sceneRadius));
            tables.links.push_back(light->links);
            ++*count;
        }
    }
    profiles.dropUnused();
    if (!shadowsShown) {
        const gpu::ShadowRecord none = *describeShadow({false}, gpu::NO_INDEX);
        tables.shadows.clear();
        for (LightRecord& record : tables.lights)
            addShadow(none, record, tables.shadows);
    }
    growTree(tables);
    const std::vector<float> sums = spreadChances(tables);
    uploadParts(tables.shapings, &LightRecord::shaping, tables.lights, shapings);
    uploadParts(tables.shadows, &LightRecord::shadow, tables.lights, shadows);
    hasShadows = !tables.shadows.empty();
    records = device.createFrom(tables.lights.data(), tables.lights.size(), "light tables");
    cumulative = device.createFrom(sums.data(), sums.size(), "light tables");
}

void LightTable::Impl::addMeshes(Tables& tables) {
    std::vector<uint32_t> lightOf(meshes.empty() ? 0 : instanceCount, gpu::NO_INDEX);
    const SurfaceLight* shaped = nullptr; // whose shaping is `shaping`: instances have one
    uint64_t shaping = 0;
    double share = 1.0;
    for (const MeshLight& mesh : meshes) {
        LightRecord record{};
        record.kind = gpu::LIGHT_MESH;
        record.radiance = glm::vec3(1.f);
        record.diffuse = record.specular = 1.f;
        record.texture = record.category = record.group = gpu::NO_INDEX;
        record.distribution = mesh.distribution;
        record.instance = mesh.instance;
        record.triangleCount = mesh.triangleCount;
        tables.powers.push_back(mesh.bounds.power);
        tables.links.push_back(mesh.bounds.links);
        if (const SurfaceLight* light = mesh.light.get()) {
            record.lightToWorld = mesh.objectToWorld;
            if (light != shaped) {
                share = shape(light->shaping, mesh.name, record, tables.shapings);
                shaping = record.shaping;
                shaped = light;
            }
            record.shaping = shaping;
            tables.powers.back() *= share * double(govern(*light, record, tables.shadows));
            tables.links.back() = CategoryTable::markOf(light->lightLink);
        }
        lightOf[mesh.instance] = uint32_t(tables.lights.size());
        tables.lights.push_back(record);
    }
    instanceLights = device.createFrom(lightOf.data(), lightOf.size(), "light tables");
}

/// What the light of a mesh says of those it lights and of its shadows. Returns the larger multiplier.
float LightTable::Impl::govern(const SurfaceLight& light, LightRecord& record,
                               std::vector<gpu::ShadowRecord>& table) {
    record.diffuse = std::max(light.diffuse, 0.f);
    record.specular = std::max(light.specular, 0.f);
    record.category = categories.category(light.lightLink);
    const auto shadow = describeShadow(light.shadow, categories.category(light.shadowLink));
    if (shadowsShown && shadow) addShadow(*shadow, record, table);
    return std::max(record.diffuse, record.specular);
}

/// Puts all lights that have a place into the tree.
void LightTable::Impl::growTree(Tables& tables) {
    std::vector<LightBounds> bounds;
    for (size_t i = 0; i < inTree(); ++i) {
        const LightRecord& record = tables.lights[i];
        const double cone = record.shaping ? double(tables.shapings[record.shaping - 1].coneAngle) : 4.0;
        if (record.kind == gpu::LIGHT_MESH) {
            bounds.push_back(meshes[i - areaLights - thinLights].bounds);
            bounds.back().power = roundedPower(tables.powers[i]);
            if (cone < glm::pi<double>())
                narrow(bounds.back(), -glm::normalize(record.lightToWorld[2]), cone);
        } else {
            bounds.push_back(boundsOf(record, cone, roundedPower(tables.powers[i])));
        }
        bounds.back().links = tables.links[i];
    }
    std::vector<uint32_t> leaves;
    const std::vector<gpu::LightNode> tree = buildLightTree(bounds, leaves);
    for (LightRecord& record : tables.lights)
        record.leaf = gpu::NO_INDEX;
    for (size_t i = 0; i < leaves.size(); ++i)
        tables.lights[i].leaf = leaves[i];
    nodes = device.createFrom(tree.data(), tree.size(), "light tables");
    nodeCount = uint32_t(tree.size());
}

/// Few lights are chosen by their power alone, many, or linked ones, by the tree, which is one choice beside
/// the infinite lights. Returns the sums of chances.
std::vector<float> LightTable::Impl::spreadChances(Tables& tables) {
    const size_t placed = inTree();
    const bool linked = std::any_of(tables.lights.begin(), tables.lights.begin() + long(placed),
                                    [](const LightRecord& light) { return light.category != gpu::NO_INDEX; });
    const bool byTree = placed > FewLights || linked;
    const auto infinite = tables.powers.begin() + long(placed);
    std::vector<double> choices = tables.powers;
    if (byTree) {
        choices.assign(infinite, tables.powers.end());
        choices.insert(choices.begin(), std::accumulate(tables.powers.begin(), infinite, 0.0));
    }
    const std::vector<double> chances = lightChances(choices);
    std::vector<float> sums = cumulativeChances(chances);
    treeChance = byTree ? float(chances[0]) : 0.f;
    if (byTree) sums.insert(sums.begin(), placed - 1, treeChance);
    for (size_t i = 0; i < tables.lights.size(); ++i)
        tables.lights[i].selectPdf = float(chances[!byTree ? i : i < placed ? 0 : i - placed + 1]);
    return sums;
}

LightTable::LightTable(Device& device, TextureStore& textures, CategoryTable& categories)
    : _impl(std::make_unique<Impl>(device, textures, categories)) {}
LightTable::~LightTable() = default;

void LightTable::set(LightId id, const LightDesc& desc, uint32_t group) {
    Impl::Light light;
    light.name = desc.name;
    light.shaping = desc.shaping;
    light.shadow = describeShadow(desc.shadow, _impl->categories.category(desc.shadowLink));
    std::string problem;
    const bool emits = describeLight(desc, light.record, problem);
    if (!problem.empty() && _impl->device.messages())
        _impl->device.messages()(Severity::Warning, desc.name, problem);
    const bool takesTexture = desc.kind == LightKind::Dome || desc.kind == LightKind::Rect;
    const WrapMode wrapS = desc.kind == LightKind::Dome ? WrapMode::Repeat : WrapMode::Clamp;
    const DomeFormat format = desc.kind == LightKind::Dome ? desc.domeFormat : DomeFormat::LatLong;
    if (emits && takesTexture && !desc.texture.empty())
        light.texture =
            _impl->textures.acquire({desc.texture, "auto", wrapS, WrapMode::Clamp, true, format}, desc.name);
    _impl->forget(id); // after the acquire: a texture in both stays loaded
    if (!emits) return;
    light.record.group = group;
    light.record.category = _impl->categories.category(desc.lightLink);
    light.links = CategoryTable::markOf(desc.lightLink);
    _impl->lights[id] = light;
    _impl->changed = true;
}

bool LightTable::forgetProfiles() {
    const bool any = _impl->profiles.forget();
    _impl->changed |= any;
    return any;
}

void LightTable::setShadows(bool shadows) {
    _impl->changed |= shadows != _impl->shadowsShown;
    _impl->shadowsShown = shadows;
}

void LightTable::remove(LightId id) {
    _impl->forget(id);
}

void LightTable::setMeshes(const std::vector<MeshLight>& meshes, uint32_t instanceCount) {
    if (meshes.empty() && _impl->meshes.empty()) return;
    if (meshes == _impl->meshes && instanceCount == _impl->instanceCount) return;
    _impl->meshes = meshes;
    _impl->instanceCount = instanceCount;
    _impl->changed = true;
}

bool LightTable::commit(const glm::vec3& boundsMin, const glm::vec3& boundsMax) {
    const double radius = 0.5 * double(glm::length(glm::max(boundsMax - boundsMin, glm::vec3(0.f))));
    const double sceneRadius =
        radius > 0.0 && std::isfinite(radius) ? radius : 1.0; // an empty scene has some size too
    const bool same = !_impl->changed && sceneRadius == _impl->sceneRadius &&
                      _impl->textureVersion == _impl->textures.version();
    if (same) return false;
    _impl->sceneRadius = sceneRadius;
    _impl->textureVersion = _impl->textures.version();
    _impl->dropPictures();
    _impl->rebuild();
    _impl->changed = false;
    return true;
}

uint32_t LightTable::count() const {
    return uint32_t(_impl->inTree()) + _impl->infiniteLights;
}

bool LightTable::emits(LightId id) const {
    return _impl->lights.count(id) > 0;
}

void LightTable::describe(gpu::SceneRecord& scene) const {
    scene.lights = _impl->records.address();
    scene.lightCumulative = _impl->cumulative.address();
    scene.lightCount = count();
    scene.areaLightCount = _impl->areaLights;
    scene.infiniteLightCount = _impl->infiniteLights;
    scene.lightNodes = _impl->nodes.address();
    scene.lightNodeCount = _impl->nodeCount;
    scene.lightTreeChance = _impl->treeChance;
    scene.instanceLights = _impl->meshes.empty() ? 0 : _impl->instanceLights.address();
    if (!_impl->meshes.empty()) scene.flags |= gpu::SCENE_HAS_MESH_LIGHTS;
    if (_impl->hasShadows) scene.flags |= gpu::SCENE_HAS_SHADOWS_TO_WALK;
}

} // namespace hipr
