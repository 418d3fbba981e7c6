#pragma once

#include "frames/checkpoint.h"
#include "frames/csv.h"
#include "frames/frame.h"
#include "frames/run_folder.h"
#include "frames/statistics.h"

#include <optional>

namespace weft {

/// Wall time that a frame took beside its stages, s.
struct FrameTiming {
    double step = 0.0;     ///< advancing to it, all stages together, but not verifying it
    double step_cpu = 0.0; ///< CPU time that the process took meanwhile, all threads together
    double verify = 0.0;   ///< the exact search for crossings
    double measure = 0.0;  ///< capture and statistics
    double draw = 0.0;     ///< the picture, beside the simulation
};

/// All that one frame leaves behind.
struct FrameRecord {
    FrameStatistics statistics;
    std::vector<std::string> problems; ///< rows of problems.csv
    FrameTiming timing;
    std::optional<Frame> frame;           ///< empty: this frame's cache is not wanted
    std::optional<Checkpoint> checkpoint; ///< empty: none is due
    RunStatus status;
};

/// Writes frames of a run in their order: cache, tables, checkpoint, status. The checkpoint comes
/// after all that it vouches for, so that a run killed at any moment finds everything up to its
/// newest checkpoint on the disk.
///
/// Tables above 1 MB are written with checkpoints only, see CsvFile; they are never cut off.
class RunWriter {
public:
    explicit RunWriter(const RunPaths& paths);

    /// Forgets what a stopped run wrote after frame `last`. Throws Error (Disk) when statistics up
    /// to it are not all there.
    void keep_through(int last);

    void write(const FrameRecord& record);

    /// Completes the tables.
    void finish();

    CsvTable statistics() const;

private:
    RunPaths paths_;
    CsvFile statistics_;
    CsvFile problems_;
    CsvFile timing_;
};

} // namespace weft
