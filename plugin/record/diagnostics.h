/// @file diagnostics.h
/// Messages of hiprrecord on stderr, OpenUSD's included, one line each.
#pragma once

#include <string>

namespace hipr::record {

enum class Verbosity {
    Quiet,  ///< errors only
    Normal, ///< and warnings
    Verbose ///< and status messages of OpenUSD and the renderer
};

/// Prints "hiprrecord: warning: ..." unless quiet.
void printWarning(const std::string& message);
/// Prints "hiprrecord: error: ...".
void printError(const std::string& message);

/// Routes OpenUSD's diagnostics of all threads into lines of the same form while it lives; no text is said
/// twice. Only one may live at a time.
class Diagnostics {
public:
    explicit Diagnostics(Verbosity verbosity);
    ~Diagnostics();
    Diagnostics(const Diagnostics&) = delete;
    Diagnostics& operator=(const Diagnostics&) = delete;

private:
    struct Route;
    Route* _route;
};

} // namespace hipr::record
