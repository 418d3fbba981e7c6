#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::test {

/// What a program left when it ended.
struct ProcessResult {
    int exit_code = -1; ///< 128 + signal when one ended it
    std::string out, err;
};

/// A program that runs beside the test.
class Process {
public:
    /// @param log folder for what it prints
    Process(const std::filesystem::path& program,
            const std::vector<std::string>& arguments,
            const std::filesystem::path& log);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const;
    bool is_running();
    ProcessResult wait();

private:
    pid_t pid_ = -1;
    int status_ = -1;
    std::filesystem::path out_, err_;
};

/// Runs weft to its end.
ProcessResult run_weft(const std::vector<std::string>& arguments, const std::filesystem::path& log);

} // namespace weft::test
