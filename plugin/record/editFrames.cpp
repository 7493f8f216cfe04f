#include "plugin/record/editFrames.h"

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "plugin/record/failure.h"

namespace fs = std::filesystem;

namespace hipr::record {

namespace {

/// Letters and digits, with single dashes for everything else.
std::string fileName(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) || byte >= 0x80 || c == '_')
            result += c;
        else if (!result.empty() && result.back() != '-')
            result += '-';
    }
    while (!result.empty() && result.back() == '-')
        result.pop_back();
    return result.substr(0, 80);
}

} // namespace

std::string editPath(const std::string& path, const Edit& edit, size_t editCount) {
    const std::string last = std::to_string(editCount), name = fileName(edit.name);
    std::string number = std::to_string(edit.index);
    number.insert(0, last.size() - std::min(last.size(), number.size()), '0');
    const fs::path whole(path);
    const std::string file =
        whole.stem().string() + "." + number + (name.empty() ? "" : "." + name) + whole.extension().string();
    return (whole.parent_path() / file).string();
}

EditFrames::EditFrames(const std::string& folder, const DisplayOptions& display)
    : _folder(folder), _display(display) {
    std::error_code error;
    fs::create_directories(folder, error);
    const std::string list = (fs::path(folder) / "frames.jsonl").string();
    _list.open(list);
    if (!_list) throw Failure(ExitOutput, "cannot write '" + list + "'");
}

void EditFrames::add(const Picture& picture, const BatchInfo& info) {
    char file[32];
    std::snprintf(file, sizeof file, "%06d.png", _count++);
    writePicture((fs::path(_folder) / file).string(), picture, _display);
    const nlohmann::ordered_json line = {
        {"file", file},        {"edit", info.edit},       {"name", info.name},
        {"batch", info.batch}, {"seconds", info.seconds}, {"samples", info.samples},
        {"paths", info.paths}};
    _list << line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
    if (!_list) throw Failure(ExitOutput, "cannot write to '" + _folder + "/frames.jsonl'");
}

} // namespace hipr::record
