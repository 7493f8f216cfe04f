/// @file main.cpp
/// hiprrecord: records a USD stage to image files with a Hydra renderer.
#include <atomic>
#include <csignal>
#include <exception>

#include "plugin/record/diagnostics.h"
#include "plugin/record/failure.h"
#include "plugin/record/options.h"
#include "plugin/record/recorder.h"

namespace {

std::atomic<bool> interrupted{false};

/// The first Ctrl-C asks the recorder to write what it has; a second one ends the program at once.
void onInterrupt(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

} // namespace

int main(int argc, char** argv) {
    using namespace hipr::record;
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    try {
        const std::optional<Options> options = parseOptions(argc, argv);
        if (!options) return ExitOk;
        const Diagnostics diagnostics(options->verbosity);
        registerPlugins();
        return record(*options, interrupted);
    } catch (const Failure& failure) {
        printError(failure.what());
        return failure.code();
    } catch (const std::exception& error) {
        printError(error.what());
        return ExitRender;
    }
}
