#include "plugin/record/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "plugin/record/failure.h"

#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/vt/value.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const VtDictionary& dictionary);

/// A value that can be cast to T, as a T. (With newer OpenUSD, GCC warns when the cast stays a temporary.)
template <class T> T castTo(const VtValue& value) {
    const VtValue cast = VtValue::Cast<T>(value);
    return cast.UncheckedGet<T>();
}

Json toJson(const VtValue& value) {
    if (value.IsHolding<VtDictionary>()) return toJson(value.UncheckedGet<VtDictionary>());
    if (value.IsHolding<bool>()) return value.UncheckedGet<bool>();
    if (value.IsHolding<std::string>()) return value.UncheckedGet<std::string>();
    const bool real = value.IsHolding<float>() || value.IsHolding<double>();
    if (!real && value.CanCast<int64_t>()) return castTo<int64_t>(value);
    if (value.CanCast<double>()) return castTo<double>(value);
    return TfStringify(value);
}

Json toJson(const VtDictionary& dictionary) {
    Json object = Json::object();
    for (const auto& [key, value] : dictionary)
        object[key] = toJson(value);
    return object;
}

std::string byteText(double bytes) {
    static const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    size_t unit = 0;
    while (bytes >= 1024.0 && unit < 4) {
        bytes /= 1024.0;
        ++unit;
    }
    return TfStringPrintf(unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
}

} // namespace

double statNumber(const VtDictionary& stats, const std::string& key, double fallback) {
    const auto found = stats.find(key);
    if (found == stats.end() || !found->second.CanCast<double>()) return fallback;
    return castTo<double>(found->second);
}

std::string reportJson(const RecordingReport& report) {
    Json root;
    root["scene"] = report.scene;
    root["renderer"] = report.renderer;
    root["camera"] = report.camera;
    root["width"] = report.width;
    root["height"] = report.height;
    root["settings"] = report.settings;
    root["openSeconds"] = report.openSeconds;
    root["frames"] = Json::array();
    for (const FrameReport& frame : report.frames) {
        Json entry;
        entry["frame"] = frame.frame;
        if (frame.edit >= 0) {
            entry["edit"] = frame.edit;
            entry["name"] = frame.editName;
        }
        entry["seconds"] = frame.seconds;
        if (frame.firstSampleSeconds >= 0) entry["firstSampleSeconds"] = frame.firstSampleSeconds;
        entry["samples"] = frame.samples;
        entry["converged"] = frame.converged;
        entry["files"] = frame.files;
        entry["renderStats"] = toJson(frame.stats);
        root["frames"].push_back(entry);
    }
    return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string memoryTable(const VtDictionary& stats) {
    const std::string group = "memory:"; // HiPR's "hipr:memory:<kind>"
    std::vector<std::pair<double, std::string>> rows;
    for (const auto& [key, value] : stats) {
        if (TfStringToLower(key).find("memory") == std::string::npos) continue;
        const size_t kind = key.find(group);
        rows.emplace_back(statNumber(stats, key, 0.0),
                          kind == std::string::npos ? key : key.substr(kind + group.size()));
    }
    if (rows.empty()) return "The renderer reports no memory.\n";
    std::sort(rows.rbegin(), rows.rend());
    std::string text;
    for (const auto& [bytes, key] : rows)
        text += TfStringPrintf("%-28s %12s\n", key.c_str(), byteText(bytes).c_str());
    return text;
}

void writeText(const std::string& path, const std::string& text) {
    if (path == "-") {
        std::fputs(text.c_str(), stdout);
        return;
    }
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file) throw Failure(ExitOutput, "cannot write '" + path + "'");
}

} // namespace hipr::record
