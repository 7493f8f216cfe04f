#include "plugin/record/diagnostics.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <unistd.h>
#include <unordered_set>

#include "plugin/record/progress.h"
#include "pxr/base/tf/diagnosticMgr.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/status.h"
#include "pxr/base/tf/warning.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

std::atomic<Verbosity> currentVerbosity{Verbosity::Normal};

void printLine(const char* kind, const std::string& message) {
    // On a terminal the progress bar may occupy the line.
    static const char* const clearLine = isatty(STDERR_FILENO) ? "\r\033[K" : "";
    std::fprintf(stderr, "%shiprrecord: %s: %s\n", clearLine, kind, message.c_str());
}

/// Composition repeats a message for every prim index that meets the same fault.
bool saidBefore(const std::string& text) {
    static std::mutex mutex;
    static std::unordered_set<std::string> said;
    const std::lock_guard<std::mutex> lock(mutex);
    return !said.insert(text).second;
}

std::string trimmed(const std::string& text) {
    const size_t begin = text.find_first_not_of(" \n\t"), end = text.find_last_not_of(" \n\t");
    return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

} // namespace

void printWarning(const std::string& message) {
    if (currentVerbosity != Verbosity::Quiet) printLine("warning", message);
}

void printError(const std::string& message) {
    printLine("error", message);
}

struct Diagnostics::Route : TfDiagnosticMgr::Delegate {
    void IssueError(const TfError& error) override {
        const std::string text = trimmed(error.GetCommentary());
        if (!saidBefore(text)) printError(text);
    }
    void IssueFatalError(const TfCallContext&, const std::string& message) override {
        printError(trimmed(message));
        _UnhandledAbort();
    }
    void IssueStatus(const TfStatus& status) override {
        if (const double* fraction = status.GetInfo<double>()) { // of our file format: a long reading
            if (currentVerbosity != Verbosity::Quiet)
                showProgress(trimmed(status.GetCommentary()), *fraction);
            return;
        }
        if (currentVerbosity == Verbosity::Verbose) printLine("status", trimmed(status.GetCommentary()));
    }
    void IssueWarning(const TfWarning& warning) override {
        const std::string text = trimmed(warning.GetCommentary());
        if (!saidBefore(text)) printWarning(text);
    }

    void showProgress(const std::string& title, double fraction);

    std::mutex mutex; ///< guards what follows: layers are read on many threads
    Progress progress{stderr, isatty(STDERR_FILENO) != 0};
    std::string progressTitle;
    std::chrono::steady_clock::time_point progressStart;
};

void Diagnostics::Route::showProgress(const std::string& title, double fraction) {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto now = std::chrono::steady_clock::now();
    if (title != progressTitle) {
        progressTitle = title;
        progressStart = now;
        progress.begin(title);
    }
    progress.update({fraction, 0, std::chrono::duration<double>(now - progressStart).count()});
    if (fraction >= 1.0) progress.end();
}

Diagnostics::Diagnostics(Verbosity verbosity) : _route(new Route) {
    currentVerbosity = verbosity;
    TfDiagnosticMgr::GetInstance().AddDelegate(_route);
}

Diagnostics::~Diagnostics() {
    TfDiagnosticMgr::GetInstance().RemoveDelegate(_route);
    delete _route;
}

} // namespace hipr::record
