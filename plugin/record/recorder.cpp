#include "plugin/record/recorder.h"

#include <cstdlib>
#include <filesystem>

#include "plugin/record/edits.h"
#include "plugin/record/lists.h"
#include "plugin/record/recording.h"
#include "plugin/record/renderProducts.h"
#include "pxr/base/plug/registry.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

void registerPlugins() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path plugins = program.parent_path().parent_path() / "plugin" / "usd";
    if (!error && std::filesystem::is_directory(plugins, error))
        PlugRegistry::GetInstance().RegisterPlugins(plugins.string());
}

ExitCode record(const Options& options, const std::atomic<bool>& interrupted) {
    if (options.onlyLists()) {
        printLists(options);
        return ExitOk;
    }
    // lavapipe asks once, when the first device is made; the user's own word is stronger.
    if (options.threads > 0) setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 0);
    const std::vector<Edit> edits =
        options.editsFile.empty() ? std::vector<Edit>() : readEdits(options.editsFile);
    const Recordings recordings = recordingsOf(options);
    ExitCode code = ExitOk;
    for (size_t i = 0; i < recordings.options.size() && code == ExitOk; ++i)
        code = Recording(recordings.options[i], edits, interrupted).run();
    return code;
}

} // namespace hipr::record
