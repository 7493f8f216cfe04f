#include "renderer/shading/light_shaping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;

double between(double x, double lo, double hi) {
    return std::min(std::max(x, lo), hi);
}

/// The profile at an angle off the axis, averaged around it.
double profileMean(const gpu::ShapingRecord& shaping, const IesProfile& profile, double theta) {
    const double scale = double(shaping.iesAngleScale);
    if (scale > 0.0) theta /= scale;
    if (scale < 0.0) theta = Pi - (Pi - theta) / -scale;
    const uint32_t row = uint32_t(between(theta / Pi, 0.0, 1.0) * (profile.rows - 1));
    double sum = 0.0;
    for (uint32_t column = 0; column < profile.columns; ++column)
        sum += double(profile.candela[size_t(row) * profile.columns + column]);
    return sum / profile.columns * double(shaping.iesFactor);
}

} // namespace

const ProfileStore::Entry* ProfileStore::find(const std::string& path, const std::string& subject) {
    const auto [found, isNew] = _entries.try_emplace(path);
    Entry& entry = found->second;
    entry.used = true;
    if (isNew) {
        std::string error;
        const std::vector<unsigned char> bytes = _assets(path);
        if (bytes.empty()) error = "cannot be read";
        if (!bytes.empty() && parseIes(bytes, entry.profile, error))
            entry.values = _device.createFrom(entry.profile.candela.data(), entry.profile.candela.size(),
                                              "light tables");
        if (!error.empty() && _device.messages())
            _device.messages()(Severity::Warning, subject,
                               path + " " + error + "; the light is not shaped by it");
    }
    return entry.values ? &entry : nullptr;
}

void ProfileStore::dropUnused() {
    for (auto it = _entries.begin(); it != _entries.end();) {
        const bool used = std::exchange(it->second.used, false);
        it = used ? std::next(it) : _entries.erase(it);
    }
}

bool ProfileStore::forget() {
    return !std::exchange(_entries, {}).empty();
}

bool isShaped(const LightShaping& shaping) {
    return shaping.focus > 0.f || shaping.coneAngle < 180.f || !shaping.iesFile.empty();
}

gpu::ShapingRecord describeShaping(const LightShaping& shaping, const ProfileStore::Entry* profile) {
    gpu::ShapingRecord record{};
    record.focus = std::max(shaping.focus, 0.f);
    record.focusTint = glm::max(shaping.focusTint, glm::vec3(0.f));
    record.coneAngle = float(between(double(shaping.coneAngle), 0.0, 180.0) * (Pi / 180.0));
    if (shaping.coneAngle >= 180.f) record.coneAngle = 4.f; // beyond any angle, rounding included
    record.coneStart = record.coneAngle * (1.f - float(between(double(shaping.coneSoftness), 0.0, 1.0)));
    if (!profile) return record;
    record.profile = profile->values.address();
    record.profileRows = profile->profile.rows;
    record.profileColumns = profile->profile.columns;
    record.iesAngleScale = shaping.iesAngleScale;
    record.iesFactor =
        shaping.iesNormalize ? (profile->profile.mean > 0.f ? 1.f / profile->profile.mean : 0.f) : 1.f;
    return record;
}

double shapedShare(const gpu::ShapingRecord& shaping, const ProfileStore::Entry* profile, bool flat) {
    constexpr int Steps = 1024;
    const double end = flat ? 0.5 * Pi : Pi;
    double sum = 0.0, all = 0.0;
    for (int i = 0; i < Steps; ++i) {
        const double theta = end * (i + 0.5) / Steps,
                     weight = std::sin(theta) * (flat ? std::cos(theta) : 1.0);
        all += weight;
        if (theta > double(shaping.coneAngle)) continue;
        double factor = 1.0;
        if (shaping.focus > 0.f) {
            const double tint = glm::dot(glm::dvec3(shaping.focusTint), glm::dvec3(0.2126, 0.7152, 0.0722));
            factor = glm::mix(tint, 1.0, std::pow(std::abs(std::cos(theta)), double(shaping.focus)));
        }
        const double fade = double(shaping.coneAngle) - double(shaping.coneStart);
        if (theta > double(shaping.coneStart) && fade > 0.0) {
            const double x = (theta - double(shaping.coneStart)) / fade;
            factor *= 1.0 - x * x * (3.0 - 2.0 * x);
        }
        if (profile) factor *= profileMean(shaping, profile->profile, theta);
        sum += weight * factor;
    }
    return sum / all;
}

} // namespace hipr
