/// @file failure.h
/// Exit codes of hiprrecord and the exception that carries one to main().
#pragma once

#include <stdexcept>
#include <string>

namespace hipr::record {

enum ExitCode : int {
    ExitOk = 0,
    ExitUsage = 1,        ///< the command line makes no sense
    ExitStage = 2,        ///< the stage cannot be read
    ExitCamera = 3,       ///< no such camera
    ExitOutput = 4,       ///< an output cannot be written
    ExitRender = 5,       ///< no renderer, no device, or rendering failed
    ExitInterrupted = 130 ///< SIGINT; what was there has been written
};

/// Ends the program with one message and an exit code.
class Failure : public std::runtime_error {
public:
    Failure(ExitCode code, const std::string& message) : std::runtime_error(message), _code(code) {}
    ExitCode code() const { return _code; }

private:
    ExitCode _code;
};

} // namespace hipr::record
