#include "app/recorder.h"

#include "base/stopwatch.h"
#include "collide/contact.h"
#include "frames/cache.h"
#include "frames/checkpoint_folder.h"

#include <algorithm>

namespace weft {

namespace {

/// Pairs that are counted at most; more would be no more telling.
constexpr std::size_t k_most_crossings = 100000;

} // namespace

Recorder::Recorder(const RunPaths& paths,
                   const Scene& scene,
                   const World& start,
                   std::uint64_t scene_hash,
                   const FrameRange& wanted)
    : paths_(paths), contact_(scene.contact), frames_(scene.scene.frames), scene_hash_(scene_hash),
      wanted_(wanted), capture_(start, scene.scene.fps), statistician_(start, scene.scene),
      writer_(paths), pictures_(paths, scene) {}

void Recorder::resume_after(int last) {
    writer_.keep_through(last);
}

void Recorder::begin() {
    write_obstacles(paths_, capture_.obstacles());
}

int Recorder::count_crossings(const World& world) const {
    if (!contact_.enabled) {
        return 0; // the scene says that nothing touches anything
    }
    const auto crossings = find_crossings(world, k_most_crossings);
    if (contact_.self) {
        return static_cast<int>(crossings.size());
    }
    const auto is_obstacle = [&](const std::string& name) {
        return std::any_of(world.obstacles.begin(), world.obstacles.end(),
                           [&](const Obstacle& obstacle) { return obstacle.name == name; });
    };
    return static_cast<int>(
        std::count_if(crossings.begin(), crossings.end(), [&](const CrossingPair& pair) {
            return is_obstacle(pair.object_a) || is_obstacle(pair.object_b);
        }));
}

void Recorder::record(const World& world,
                      const FrameReport& report,
                      double step_seconds,
                      const Progress& progress) {
    auto record = std::make_shared<FrameRecord>();
    record->timing.step = step_seconds;
    int crossings = 0;
    {
        const ScopedTime time(record->timing.verify);
        crossings = count_crossings(world);
    }
    {
        const ScopedTime time(record->timing.measure);
        record->statistics = statistician_.measure(world, report, crossings);
        if (wanted_.contains(world.frame)) {
            record->frame = capture_.capture(world);
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
