#include "renderer/volumes/vdb_reader.h"

#include <filesystem>
#include <optional>

#include <dlfcn.h>

#include "renderer/volumes/field_builder.h"
#include "renderer/volumes/vdb_door.h"

namespace hipr {
namespace {

namespace fs = std::filesystem;

/// Makes a FieldFile of what the module tells.
class Receiver final : public VdbReceiver {
public:
    void start(const char* grid, uint32_t channels, const double* latticeToObject) override {
        glm::dmat4x3 matrix;
        std::copy_n(latticeToObject, 12, &matrix[0][0]);
        _name = grid;
        _builder.emplace(_name, channels, matrix);
    }
    void brick(const int* at, const float* values, size_t count) override {
        _values.assign(values, values + count);
        _builder->add({at[0], at[1], at[2]}, _values);
    }
    void error(const char* text) override { _error = text; }

    FieldFile finish() {
        FieldFile file;
        file.error = _error;
        if (!_error.empty() || !_builder) return file;
        file.grid = _builder->finish();
        if (!file.grid) file.error = _name + VdbTooLarge;
        if (_builder->repaired())
            file.warning = _name + " has values that are not finite or below 0; they count as 0";
        return file;
    }

private:
    std::string _name, _error;
    std::optional<FieldBuilder> _builder;
    std::vector<float> _values;
};

/// The folder of the binary that this code has become part of.
fs::path ownFolder() {
    Dl_info info{};
    std::error_code none;
    fs::path own;
    if (dladdr(reinterpret_cast<const void*>(&openVdbModule), &info) && info.dli_fname)
        own = fs::canonical(info.dli_fname, none);
    if (own.empty()) own = fs::canonical("/proc/self/exe", none); // a program has the name it was called by
    return own.parent_path();
}

FieldFile read(const VdbRequest& request) {
    static const VdbModule module = openVdbModule(vdbModuleFolders());
    FieldFile refused;
    if (!module.read) {
        refused.error = "'" + std::string(request.path) + "' is not read: " + module.error;
        return refused;
    }
    Receiver receiver;
    module.read(request, receiver);
    return receiver.finish();
}

} // namespace

std::vector<std::string> vdbModuleFolders() {
    const fs::path own = ownFolder();
    return {own.string(), (own.parent_path() / "plugin/usd").string()};
}

VdbModule openVdbModule(const std::vector<std::string>& folders) {
    VdbModule module;
    module.error = std::string("HiPR's module for OpenVDB files, ") + VdbModuleFile + ", is not in";
    for (const std::string& folder : folders) {
        const std::string path = folder + "/" + VdbModuleFile;
        std::error_code none;
        if (!fs::exists(path, none)) {
            module.error += " '" + folder + "'";
            continue;
        }
        // Nobody else sees its symbols or those of OpenVDB. Never closed: OpenVDB keeps tables of its own.
        void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        module.read = handle ? reinterpret_cast<ReadVdb>(dlsym(handle, ReadVdbName)) : nullptr;
        const char* reason = module.read ? nullptr : dlerror();
        module.error = reason ? reason : "";
        break;
    }
    return module;
}

FieldFile readVdbFile(const std::string& path, const FieldChoice& choice) {
    return read({path.c_str(), nullptr, 0, choice.grid.c_str(), choice.index});
}

FieldFile readVdbMemory(const unsigned char* data, size_t bytes, const std::string& name,
                        const FieldChoice& choice) {
    return read({name.c_str(), data, bytes, choice.grid.c_str(), choice.index});
}

} // namespace hipr
