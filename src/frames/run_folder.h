#pragma once

#include <filesystem>
#include <string>

namespace weft {

/// Where each file of a run stands; docs/output.md says what is in them.
struct RunPaths {
    std::filesystem::path folder;

    std::filesystem::path scene() const { return folder / "scene.resolved.toml"; }
    std::filesystem::path stats() const { return folder / "stats.csv"; }
    std::filesystem::path problems() const { return folder / "problems.csv"; }
    std::filesystem::path timing() const { return folder / "timing.csv"; }
    std::filesystem::path images() const { return folder / "images.csv"; }
    std::filesystem::path status() const { return folder / "status.json"; }
    std::filesystem::path log() const { return folder / "log.txt"; }
    std::filesystem::path frames_dir() const { return folder / "frames"; }
    std::filesystem::path cache_dir() const { return folder / "cache"; }
    std::filesystem::path checkpoints_dir() const { return folder / "checkpoints"; }

    /// frames/frame.0001.png
    std::filesystem::path picture(int frame) const;
    /// cache/NAME.0001.ply: what moves by forces and obstacles that deform, one a frame
    std::filesystem::path shape(const std::string& name, int frame) const;
    /// cache/NAME.ply: a rigid obstacle in its own frame, once
    std::filesystem::path obstacle(const std::string& name) const;
    /// cache/NAME.reach.ply: of an obstacle that deforms, points that it gets to
    std::filesystem::path reach(const std::string& name) const;
    /// checkpoints/0010.weft
    std::filesystem::path checkpoint(int frame) const;
    /// checkpoints/failed.weft: the last good state of a run that diverged, for a look at it
    std::filesystem::path failed_checkpoint() const { return checkpoints_dir() / "failed.weft"; }
};

/// What to do with a folder that already holds something.
enum class FolderMode { Fresh, Resume, Overwrite };

/// Says in one line why a run may not go to this folder, before anything is computed or touched.
/// A folder that is not there, is empty, or holds no more than a run leaves that was killed before
/// its scene was written suits every mode. Fresh: no other does. Resume, Overwrite: only one that
/// an earlier run of ours made (scene.resolved.toml is there). Throws Error (CommandLine), or Error
/// (Disk) when the folder cannot be read.
void check_run_folder(const std::filesystem::path& folder, FolderMode mode);

/// The folder of one run, held against a second process that would write into it.
class RunFolder {
public:
    /// Checks as above and makes the folder and its parts. Overwrite removes the files of the
    /// earlier run first, and only such files: a stranger's stay. Resume removes what an
    /// interrupted write left aside.
    /// Throws Error: CommandLine when the folder does not suit or another run holds it, Disk when
    /// it cannot be made or written.
    RunFolder(const std::filesystem::path& folder, FolderMode mode);
    ~RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;

    const RunPaths& paths() const { return paths_; }

private:
    RunPaths paths_;
    int lock_ = -1; ///< descriptor of the folder
};

enum class RunState { Running, Done, Failed, Stopped };

/// What status.json says: for scripts that watch a run. Times are wall-clock seconds.
struct RunStatus {
    RunState state = RunState::Running;
    int frame = 0;  ///< last complete frame; 0: none yet
    int frames = 0; ///< length of the whole run
    double seconds_per_frame = 0.0;
    double seconds_left = 0.0;
    int exit_code = 0;   ///< the process returned it; 0 while it runs
    std::string message; ///< why it ended; empty while it runs
};

/// Replaces the file. Adds percent, the process id and the program's version.
void write_status(const std::filesystem::path& file, const RunStatus& status);

/// Throws Error (Disk) in one line when the file is missing or not a status.
RunStatus read_status(const std::filesystem::path& file);

/// The version of this program, e.g. "0.1.0".
std::string program_version();

} // namespace weft
