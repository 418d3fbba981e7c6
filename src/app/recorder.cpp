#include "app/recorder.h"

#include "base/stopwatch.h"
#include "frames/cache.h"
#include "frames/problems.h"
#include "frames/resume.h"

#include <algorithm>

namespace weft {

Recorder::Recorder(const RunPaths& paths,
                   const Scene& scene,
                   const World& start,
                   std::uint64_t scene_hash,
                   const FrameRange& wanted)
    : paths_(paths), contact_(scene.contact), frames_(scene.scene.frames), scene_hash_(scene_hash),
      wanted_(wanted), capture_(start, scene.scene.fps, scene.scene.frames),
      statistics_collector_(start, scene.scene), crossings_(start, scene.contact.self),
      writer_(paths), pictures_(paths, scene) {}

void Recorder::resume_after(int last) {
    writer_.keep_through(last);
}

void Recorder::begin() {
    write_obstacles(paths_, capture_.obstacles());
}

/// What the substeps left and what crosses now.
std::vector<UnresolvedPair>
Recorder::find_problems(const World& world, const FrameReport& report, int& crossings) {
    std::vector<UnresolvedPair> problems = report.problems;
    crossings = report.crossings;
    if (contact_.enabled) { // else the scene says that nothing touches anything
        const std::vector<UnresolvedPair> found = crossings_.find(world, world.time);
        crossings = std::max(crossings, static_cast<int>(found.size()));
        add_unresolved(problems, world.time, found);
        keep_last_of_each(problems);
    }
    return problems;
}

void Recorder::record(const World& world,
                      const FrameReport& report,
                      FrameTiming timing,
                      const Progress& progress) {
    auto record = std::make_shared<FrameRecord>();
    record->timing = timing;
    int crossings = 0;
    std::vector<UnresolvedPair> problems;
    {
        const ScopedTime time(record->timing.verify);
        problems = find_problems(world, report, crossings);
    }
    {
        const ScopedTime time(record->timing.measure);
        record->statistics = statistics_collector_.measure(world, report, crossings);
        record->problems = problem_rows(world.frame, problems, world);
        if (wanted_.contains(world.frame)) {
            record->frame = capture_.capture(world);
            record->frame->problems = places_of(problems);
        }
        if (world.frame % k_checkpoint_interval == 0 || world.frame == frames_) {
            record->checkpoint = make_checkpoint(world, scene_hash_);
        }
    }
    const double elapsed = progress.elapsed();
    record->status = {.state = RunState::Running,
                      .frame = world.frame,
                      .frames = frames_,
                      .seconds_per_frame = progress.clock().seconds_per_frame(world.frame, elapsed),
                      .seconds_left = progress.clock().seconds_left(world.frame, elapsed)};
    worker_.push([this, record] {
        if (record->frame) {
            const ScopedTime time(record->timing.draw);
            pictures_.draw(*record->frame);
        }
        writer_.write(*record);
    });
}

void Recorder::checkpoint(const World& world) {
    auto checkpoint = std::make_shared<Checkpoint>(make_checkpoint(world, scene_hash_));
    worker_.push([this, checkpoint] {
        writer_.finish(); // a checkpoint vouches for the tables
        save_checkpoint(paths_, *checkpoint);
    });
}

void Recorder::finish() {
    worker_.push([this] { pictures_.release(); });
    worker_.finish();
    writer_.finish();
}

} // namespace weft
