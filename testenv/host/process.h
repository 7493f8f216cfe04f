/// @file process.h
/// Runs a program as a child process and keeps what it prints.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace hipr::test {

struct Outcome {
    int code = -1;    ///< exit code; 128 + signal when a signal ended it
    std::string text; ///< standard output and standard error together
};

class Process {
public:
    /// Starts `arguments[0]` (looked up in PATH).
    explicit Process(const std::vector<std::string>& arguments);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Reads output until it holds `text` or the program ends. Returns whether it was found.
    bool waitFor(const std::string& text);
    void interrupt(); ///< sends SIGINT
    Outcome finish(); ///< waits for the end

private:
    bool readMore();
    pid_t _pid = -1;
    int _pipe = -1;
    std::string _text;
};

Outcome run(const std::vector<std::string>& arguments);

} // namespace hipr::test
