#include "testenv/host/process.h"

#include <csignal>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace hipr::test {

Process::Process(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    _pid = fork();
    if (_pid < 0) throw std::runtime_error("no process");
    if (_pid == 0) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        close(ends[0]);
        close(ends[1]);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    close(ends[1]);
    _pipe = ends[0];
}

Process::~Process() {
    if (_pid > 0) {
        kill(_pid, SIGKILL);
        waitpid(_pid, nullptr, 0);
    }
    close(_pipe);
}

bool Process::readMore() {
    char buffer[4096];
    const ssize_t count = read(_pipe, buffer, sizeof(buffer));
    if (count <= 0) return false;
    _text.append(buffer, size_t(count));
    return true;
}

bool Process::waitFor(const std::string& text) {
    while (_text.find(text) == std::string::npos)
        if (!readMore()) return false;
    return true;
}

void Process::interrupt() {
    kill(_pid, SIGINT);
}

Outcome Process::finish() {
    while (readMore()) {
    }
    int status = 0;
    waitpid(_pid, &status, 0);
    _pid = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), _text};
}

Outcome run(const std::vector<std::string>& arguments) {
    return Process(arguments).finish();
}

} // namespace hipr::test
