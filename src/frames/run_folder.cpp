#include "frames/run_folder.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace weft {

namespace fs = std::filesystem;

namespace {

/// True for what a run makes before it writes its scene: its empty folders, its log and that
/// file half done.
bool is_bare(const fs::directory_entry& entry, const RunPaths& paths) {
    const fs::path& path = entry.path();
    if (path == paths.scene().string() + ".part") {
        return true;
    }
    if (path == paths.log() && fs::is_directory(paths.checkpoints_dir())) {
        return true;
    }
    const bool ours =
        path == paths.frames_dir() || path == paths.cache_dir() || path == paths.checkpoints_dir();
    std::error_code error; // one that cannot be read is not ours to touch
    return ours && entry.is_directory(error) && fs::is_empty(path, error) && !error;
}

bool holds_nothing(const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (status.type() == fs::file_type::not_found) {
        return true;
    }
    if (error) {
        fail_disk("{}: cannot read: {}", folder.string(), error.message());
    }
    if (status.type() != fs::file_type::directory) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("{}: is a file: -o must name a folder", folder.string()));
    }
    fs::directory_iterator entries(folder, error);
    if (error) {
        fail_disk("{}: cannot read: {}", folder.string(), error.message());
    }
    return std::all_of(begin(entries), end(entries),
                       [&](const fs::directory_entry& entry) { return is_bare(entry, {folder}); });
}

bool is_run(const RunPaths& paths) {
    return fs::exists(paths.scene());
}

[[noreturn]] void refuse(const fs::path& folder, const char* reason) {
    throw Error(ExitCode::CommandLine, fmt::format("{}: {}", folder.string(), reason));
}

/// Files of one folder whose names a run gives: begin and end so, or are such a file half written.
void collect(const fs::path& folder,
             std::string_view begin,
             std::string_view end,
             std::vector<fs::path>& files) {
    std::error_code ignored; // no folder: no files
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        std::string name = entry.path().filename().string();
        if (name.ends_with(".part")) {
            name.resize(name.size() - 5);
        }
        if (name.starts_with(begin) && name.ends_with(end) && !entry.is_directory()) {
            files.push_back(entry.path());
        }
    }
}

/// The scene last: as long as it is there the folder is known as ours.
std::vector<fs::path> files_of_run(const RunPaths& paths) {
    std::vector<fs::path> files;
    collect(paths.frames_dir(), "frame.", ".png", files);
    collect(paths.cache_dir(), "", ".ply", files);
    collect(paths.checkpoints_dir(), "", ".weft", files);
    for (const fs::path& file : {paths.stats(), paths.problems(), paths.timing(), paths.images(),
                                 paths.log(), paths.status(), paths.scene()}) {
        files.push_back(file);
        files.push_back(file.string() + ".part");
    }
    return files;
}

void remove_files(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        std::error_code error;
        fs::remove(file, error); // that it is not there is no error
        if (error) {
            fail_disk("{}: cannot remove: {}", file.string(), error.message());
        }
    }
}

std::vector<fs::path> half_written(const RunPaths& paths) {
    std::vector<fs::path> parts;
    for (const fs::path& file : files_of_run(paths)) {
        if (file.extension() == ".part") {
            parts.push_back(file);
        }
    }
    return parts;
}

void make_folders(const RunPaths& paths) {
    for (const fs::path& folder :
         {paths.folder, paths.frames_dir(), paths.cache_dir(), paths.checkpoints_dir()}) {
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) {
            fail_disk("{}: cannot make the folder: {}", folder.string(), error.message());
        }
    }
}

/// A descriptor that keeps others out until it is closed, also by the death of the process; -1
/// where the file system has no locks.
int lock_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(descriptor);
        refuse(folder, "another weft is writing here: wait for it or choose another -o");
    }
    return descriptor;
}

} // namespace

std::filesystem::path RunPaths::picture(int frame) const {
    return frames_dir() / fmt::format("frame.{:04}.png", frame);
}

std::filesystem::path RunPaths::shape(const std::string& name, int frame) const {
    return cache_dir() / fmt::format("{}.{:04}.ply", name, frame);
}

std::filesystem::path RunPaths::obstacle(const std::string& name) const {
    return cache_dir() / fmt::format("{}.ply", name);
}

std::filesystem::path RunPaths::reach(const std::string& name) const {
    return cache_dir() / fmt::format("{}.reach.ply", name);
}

std::filesystem::path RunPaths::checkpoint(int frame) const {
    return checkpoints_dir() / fmt::format("{:04}.weft", frame);
}

void check_run_folder(const fs::path& folder, FolderMode mode) {
    if (folder.empty()) {
        throw Error(ExitCode::CommandLine, "-o: must name the folder that the run goes to");
    }
    if (holds_nothing(folder)) {
        return;
    }
    if (mode == FolderMode::Fresh) {
        refuse(folder, "is not empty: --resume continues the run in it, --overwrite replaces it");
    }
    if (!is_run({folder})) {
        refuse(folder, mode == FolderMode::Resume
                           ? "holds no run to resume (no scene.resolved.toml)"
                           : "is not the folder of a run (no scene.resolved.toml): "
                             "nothing in it was overwritten");
    }
}

RunFolder::RunFolder(const fs::path& folder, FolderMode mode) : paths_{folder} {
    check_run_folder(folder, mode);
    const bool had_run = is_run(paths_);
    make_folders(paths_);
    lock_ = lock_folder(folder);
    if (had_run) {
        remove_files(mode == FolderMode::Overwrite ? files_of_run(paths_) : half_written(paths_));
    }
}

RunFolder::~RunFolder() {
    if (lock_ >= 0) {
        ::close(lock_);
    }
}

NLOHMANN_JSON_SERIALIZE_ENUM(RunState,
                             {{RunState::Failed, "failed"},
                              {RunState::Running, "running"},
                              {RunState::Done, "done"},
                              {RunState::Stopped, "stopped"}})

void write_status(const std::filesystem::path& file, const RunStatus& status) {
    const double fraction =
        status.frames > 0 ? static_cast<double>(status.frame) / status.frames : 0;
    nlohmann::ordered_json json{
        {"state", status.state},
        {"frame", status.frame},
        {"frames", status.frames},
        {"percent", 100.0 * fraction},
        {"seconds_per_frame", status.seconds_per_frame},
        {"seconds_left", status.seconds_left},
        {"pid", ::getpid()},
        {"exit_code", status.exit_code},
        {"message", status.message},
        {"version", program_version()},
    };
    // A path in a message may hold bytes that are no UTF-8.
    write_atomically(
        file,
        std::string_view(
            json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"));
}

RunStatus read_status(const std::filesystem::path& file) {
    try {
        const auto json = nlohmann::json::parse(read_file(file));
        return {.state = json.at("state").get<RunState>(),
                .frame = json.at("frame").get<int>(),
                .frames = json.at("frames").get<int>(),
                .seconds_per_frame = json.at("seconds_per_frame").get<double>(),
                .seconds_left = json.at("seconds_left").get<double>(),
                .exit_code = json.at("exit_code").get<int>(),
                .message = json.at("message").get<std::string>()};
    } catch (const nlohmann::json::exception&) {
        fail_disk("{}: not a status that weft wrote", file.string());
    }
}

std::string program_version() {
    return WEFT_VERSION;
}

} // namespace weft
