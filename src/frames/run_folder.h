#pragma once

#include "frames/run_paths.h"

namespace weft {

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

} // namespace weft
