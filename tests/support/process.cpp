#include "support/process.h"

#include "base/atomic_file.h"
#include "support/paths.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace weft::test {

namespace {

int open_for_writing(const std::filesystem::path& file) {
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
}

} // namespace

Process::Process(const std::filesystem::path& program,
                 const std::vector<std::string>& arguments,
                 const std::filesystem::path& log)
    : out_(log / "stdout.txt"), err_(log / "stderr.txt") {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) {
        throw std::runtime_error("cannot start a process");
    }
    if (pid_ == 0) {
        ::dup2(open_for_writing(out_), STDOUT_FILENO);
        ::dup2(open_for_writing(err_), STDERR_FILENO);
        ::execv(program.c_str(), argv.data());
        ::_exit(127);
    }
}

Process::~Process() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        wait();
    }
}

void Process::send(int signal) const {
    if (pid_ > 0) {
        ::kill(pid_, signal);
    }
}

bool Process::is_running() {
    if (pid_ > 0 && ::waitpid(pid_, &status_, WNOHANG) == pid_) {
        pid_ = -1;
    }
    return pid_ > 0;
}

ProcessResult Process::wait() {
    if (pid_ > 0) {
        ::waitpid(pid_, &status_, 0);
        pid_ = -1;
    }
    return {.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_),
            .out = read_file(out_),
            .err = read_file(err_)};
}

ProcessResult run_weft(const std::vector<std::string>& arguments,
                       const std::filesystem::path& log) {
    return Process(weft_binary(), arguments, log).wait();
}

} // namespace weft::test
