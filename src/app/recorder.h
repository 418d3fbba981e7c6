#pragma once

#include "app/options.h"
#include "app/ordered_worker.h"
#include "app/pictures.h"
#include "app/progress.h"
#include "collide/crossings.h"
#include "frames/capture.h"
#include "frames/run_writer.h"

#include <memory>

namespace weft {

/// Takes each frame out of the simulation and has it written and drawn while the next one is
/// computed.
class Recorder {
public:
    Recorder(const RunPaths& paths,
             const Scene& scene,
             const World& start,
             std::uint64_t scene_hash,
             const FrameRange& wanted);

    /// Takes up a stopped run after frame `last`.
    void resume_after(int last);

    /// Takes over its pictures up to that frame; 0: draws all anew.
    void keep_pictures_through(int last) { pictures_.keep_through(last); }

    /// Writes what is written once: the obstacles.
    void begin();

    /// The frame that the world stands at. Throws what writing an earlier one threw.
    void record(const World& world,
                const FrameReport& report,
                FrameTiming timing,
                const Progress& progress);

    /// Makes sure that the run can go on from the world's frame.
    void checkpoint(const World& world);

    /// Waits until all is written and completes the tables.
    void finish();

    /// The pictures so far; to be asked after finish().
    PictureTable& pictures() { return pictures_.table(); }

    CsvTable statistics() const { return writer_.statistics(); }

private:
    std::vector<UnresolvedPair>
    find_problems(const World& world, const FrameReport& report, int& crossings);

    RunPaths paths_;
    ContactParams contact_;
    int frames_;
    std::uint64_t scene_hash_;
    FrameRange wanted_;
    FrameCapture capture_;
    StatisticsCollector statistics_collector_;
    WorldCrossings crossings_;
    RunWriter writer_;
    LivePictures pictures_;
    OrderedWorker worker_{k_queue}; ///< last: its jobs use the others

    /// Frames that may wait: enough to even out slow disks, few enough to hold little memory.
    static constexpr std::size_t k_queue = 4;
};

} // namespace weft
