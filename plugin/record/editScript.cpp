// Edit scripts are JSON, so that programs can write them and people can read them.
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "plugin/record/edits.h"
#include "plugin/record/failure.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

using Json = nlohmann::ordered_json; // renames and settings happen in the order written

/// Turns one JSON object into an Edit.
class Reader {
public:
    explicit Reader(int index) { _edit.index = index; }
    Edit read(const Json& json);

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Failure(ExitUsage, _edit.title() + ": " + why);
    }
    std::string text(const Json& json, const std::string& field) const;
    double number(const Json& json, const std::string& field) const;
    const Json& object(const Json& json, const std::string& field) const;
    SdfPath path(const std::string& path, const std::string& field) const;
    std::vector<std::string> texts(const Json& json, const std::string& field) const;
    std::vector<SdfPath> paths(const Json& json, const std::string& field) const;
    void readAt(const Json& json);
    void readVariants(const Json& json);
    void readSettings(const Json& json);

    Edit _edit;
};

Edit Reader::read(const Json& json) {
    if (!json.is_object()) fail("it is no object { ... }");
    if (json.contains("name")) _edit.name = text(json["name"], "name"); // first: messages show it
    const std::map<std::string, std::function<void(const Json&)>> fields = {
        {"name", [](const Json&) {}},
        {"at", [&](const Json& j) { readAt(j); }},
        {"usda", [&](const Json& j) { _edit.usda = text(j, "usda"); }},
        {"remove", [&](const Json& j) { _edit.remove = paths(j, "remove"); }},
        {"deactivate", [&](const Json& j) { _edit.deactivate = paths(j, "deactivate"); }},
        {"activate", [&](const Json& j) { _edit.activate = paths(j, "activate"); }},
        {"rename",
         [&](const Json& j) {
             for (const auto& [from, to] : object(j, "rename").items())
                 _edit.rename.emplace_back(path(from, "rename"), path(text(to, "rename"), "rename"));
         }},
        {"variant", [&](const Json& j) { readVariants(j); }},
        {"time", [&](const Json& j) { _edit.time = number(j, "time"); }},
        {"mute", [&](const Json& j) { _edit.mute = texts(j, "mute"); }},
        {"unmute", [&](const Json& j) { _edit.unmute = texts(j, "unmute"); }},
        {"camera", [&](const Json& j) { _edit.camera = text(j, "camera"); }},
        {"setting", [&](const Json& j) { readSettings(j); }},
    };
    for (const auto& [key, value] : json.items()) {
        const auto field = fields.find(key);
        if (field == fields.end()) {
            std::string known;
            for (const auto& [name, reader] : fields)
                known += " " + name;
            fail("there is no field '" + key + "'. Known fields:" + known);
        }
        field->second(value);
    }
    return _edit;
}

std::string Reader::text(const Json& json, const std::string& field) const {
    if (!json.is_string()) fail("'" + field + "' takes text, not " + json.dump());
    return json.get<std::string>();
}

double Reader::number(const Json& json, const std::string& field) const {
    if (!json.is_number()) fail("'" + field + "' takes a number, not " + json.dump());
    return json.get<double>();
}

const Json& Reader::object(const Json& json, const std::string& field) const {
    if (!json.is_object()) fail("'" + field + "' takes an object { ... }, not " + json.dump());
    return json;
}

SdfPath Reader::path(const std::string& path, const std::string& field) const {
    const SdfPath result = SdfPath::IsValidPathString(path) ? SdfPath(path) : SdfPath();
    if (!result.IsAbsolutePath() || !result.IsPrimPath())
        fail("'" + field + "': '" + path + "' is no absolute prim path");
    return result;
}

std::vector<std::string> Reader::texts(const Json& json, const std::string& field) const {
    if (!json.is_array()) fail("'" + field + "' takes a list [ ... ], not " + json.dump());
    std::vector<std::string> result;
    for (const Json& item : json)
        result.push_back(text(item, field));
    return result;
}

std::vector<SdfPath> Reader::paths(const Json& json, const std::string& field) const {
    std::vector<SdfPath> result;
    for (const std::string& item : texts(json, field))
        result.push_back(path(item, field));
    return result;
}

void Reader::readAt(const Json& json) {
    const bool samples = json.is_object() && json.size() == 1 && json.contains("samples");
    const bool seconds = json.is_object() && json.size() == 1 && json.contains("seconds");
    if (!samples && !seconds) fail(R"('at' takes {"samples": N} or {"seconds": S}, not )" + json.dump());
    const double value = number(json.begin().value(), "at");
    if (samples && (value < 1 || value > (1 << 20) || value != std::floor(value)))
        fail("'at': samples are a whole number from 1 to " + std::to_string(1 << 20));
    if (seconds && !(value >= 0)) fail("'at': seconds cannot be negative");
    if (samples)
        _edit.afterSamples = int(value);
    else
        _edit.afterSeconds = value;
}

void Reader::readVariants(const Json& json) {
    for (const auto& [prim, selections] : object(json, "variant").items())
        for (const auto& [set, selection] : object(selections, "variant").items())
            _edit.variants.push_back({path(prim, "variant"), set, text(selection, "variant")});
}

void Reader::readSettings(const Json& json) {
    for (const auto& [key, value] : object(json, "setting").items()) {
        if (value.is_structured() || value.is_null())
            fail("'setting': '" + key + "' takes a number, true, false or text");
        _edit.settings.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    }
}

} // namespace

std::vector<Edit> parseEdits(const std::string& json) {
    Json root;
    try {
        root = Json::parse(json);
    } catch (const Json::exception& error) {
        throw Failure(ExitUsage, std::string("it is no JSON: ") + error.what());
    }
    if (!root.is_object() || root.size() != 1 || !root.contains("edits") || !root["edits"].is_array())
        throw Failure(ExitUsage, R"(it is not of the form {"edits": [ {...}, ... ]})");
    std::vector<Edit> edits;
    for (const Json& edit : root["edits"])
        edits.push_back(Reader(int(edits.size()) + 1).read(edit));
    return edits;
}

std::vector<Edit> readEdits(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string json{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.is_open() || file.bad()) throw Failure(ExitUsage, "cannot read the edits '" + path + "'");
    try {
        return parseEdits(json);
    } catch (const Failure& failure) {
        throw Failure(failure.code(), path + ": " + failure.what());
    }
}

} // namespace hipr::record
