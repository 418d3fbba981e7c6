#include "app/simulation.h"

#include "app/pictures.h"
#include "app/recorder.h"
#include "app/signals.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/acceptance.h"
#include "frames/resume.h"
#include "frames/run_folder.h"
#include "scene/scene_writer.h"
#include "step/advance.h"

#include <csignal>

namespace weft {

namespace {

/// One run from its first step to its exit code.
class Simulation {
public:
    Simulation(const Scene& scene,
               const Prepared& start,
               const RunPaths& paths,
               const SimulationOptions& options)
        : scene_(scene), world_(start.world()), paths_(paths), options_(options),
          frames_(scene.scene.frames), hash_(run_hash(scene, world_)), stepper_(start),
          recorder_(paths, scene, world_, hash_, options.frames) {
        if (options.verify && scene.contact.enabled) {
            stepper_.verify_substeps(world_);
        }
    }

    ExitCode run();

private:
    bool begin();
    bool pictures_hold(const std::string& scene_text) const;
    bool advance_all(Progress& progress);
    bool complete_pictures();
    ExitCode stop();
    ExitCode judge();
    void dump_failure();
    void end(RunState state, ExitCode code, const std::string& message) const;
    int last_written() const;
    bool should_stop() const;

    const Scene& scene_;
    World world_;
    RunPaths paths_;
    SimulationOptions options_;
    int frames_;
    std::uint64_t hash_;
    Stepper stepper_;
    Recorder recorder_;
    StopSignals signals_;
    Stopwatch watch_;
    double seconds_per_frame_ = 0.0; ///< mean over the frames that this process made
};

ExitCode Simulation::run() {
    try {
        if (begin()) {
            spdlog::info("{}: the run is finished, nothing is left to do", paths_.folder.string());
            return judge();
        }
        Progress progress(world_.frame, frames_, options_.verbosity);
        const bool complete = advance_all(progress);
        progress.finish();
        recorder_.finish();
        seconds_per_frame_ = progress.clock().seconds_per_frame(world_.frame, progress.elapsed());
        return complete && complete_pictures() ? judge() : stop();
    } catch (const Error& error) {
        end(RunState::Failed, error.code(), error.what());
        throw;
    } catch (const std::exception& error) {
        end(RunState::Failed, ExitCode::OurFault, error.what());
        throw;
    }
}

/// Prepares the folder and takes up what a stopped run left. True: that run was finished already.
bool Simulation::begin() {
    const auto checkpoint =
        find_resume_point(paths_, scene_, hash_, [](const std::string& line) { warn("{}", line); });
    const bool has_frame = checkpoint.has_value();
    recorder_.resume_after(has_frame ? checkpoint->frame : 0);
    if (has_frame) {
        restore(*checkpoint, world_);
        if (world_.frame == frames_ && std::filesystem::exists(paths_.status()) &&
            read_status(paths_.status()).state == RunState::Done) {
            return true;
        }
        spdlog::info("{}: goes on after frame {}", paths_.folder.string(), world_.frame);
    }
    const std::string text = write_scene(scene_, paths_.folder);
    recorder_.keep_pictures_through(has_frame && pictures_hold(text) ? world_.frame : 0);
    write_atomically(paths_.scene(), std::string_view(text));
    recorder_.begin();
    end(RunState::Running, ExitCode::Done, "");
    if (!has_frame) {
        recorder_.record(world_, {}, {}, Progress(0, frames_, Verbosity::Quiet));
    }
    return false;
}

/// True when the folder's pictures are of this very scene; those of a finished run may have been
/// drawn again in another way.
bool Simulation::pictures_hold(const std::string& scene_text) const {
    return std::filesystem::exists(paths_.scene()) && read_file(paths_.scene()) == scene_text &&
           std::filesystem::exists(paths_.status()) &&
           read_status(paths_.status()).state != RunState::Done;
}

/// Frame by frame to the last. False: asked to stop before it.
bool Simulation::advance_all(Progress& progress) {
    while (world_.frame < frames_) {
        const Stopwatch watch;
        const CpuStopwatch cpu;
        std::optional<FrameReport> report;
        try {
            report = stepper_.advance_frame(world_, [&] { return should_stop(); });
        } catch (const Error&) {
            dump_failure();
            throw;
        }
        if (!report) {
            return false;
        }
        recorder_.record(world_, *report,
                         {.step = watch.seconds() - report->seconds.verify,
                          .step_cpu = cpu.seconds(),
                          .verify = report->seconds.verify},
                         progress);
        const int contacts = report->contact.contacts_obstacle + report->contact.contacts_self;
        progress.show({world_.frame, world_.triangle_count(), contacts});
        spdlog::debug("frame {}: {} substeps, {} retries, {} contacts, {} unresolved, {:.3f} s",
                      world_.frame, report->substeps, report->retries, contacts,
                      report->contact.unresolved, watch.seconds());
    }
    return true;
}

/// Draws what the run has not drawn by now: all once more when the motion was not as predicted.
/// False: asked to stop before the last.
bool Simulation::complete_pictures() {
    if (!scene_.render.enabled) {
        return true;
    }
    const CachedRun run(paths_.folder, scene_);
    const PictureBounds bounds = picture_bounds(run, scene_);
    PictureTable& table = recorder_.pictures();
    std::vector<int> frames = run.frames();
    if (bounds.is_as_predicted) {
        std::erase_if(frames, [&](int frame) { return table.has(frame); });
    } else {
        spdlog::info("{}: the motion was not as foreseen: drawing the pictures again, fitted to it",
                     paths_.folder.string());
    }
    if (frames.empty()) {
        return true;
    }
    Progress progress(0, static_cast<int>(frames.size()), options_.verbosity);
    const PictureJob job{.folder = paths_.frames_dir(),
                         .frames = frames,
                         .should_stop = [&] { return should_stop(); },
                         .on_frame = [&](int drawn) { progress.show_pictures(drawn); }};
    return draw_run(run, scene_, bounds.motion, job, table);
}

ExitCode Simulation::stop() {
    recorder_.checkpoint(world_);
    recorder_.finish();
    const std::string message =
        fmt::format("stopped by {} after frame {}; --resume goes on from there",
                    StopSignals::received() == SIGINT    ? "SIGINT"
                    : StopSignals::received() == SIGTERM ? "SIGTERM"
                                                         : "the time limit",
                    world_.frame);
    warn("{}: {}", paths_.folder.string(), message);
    end(RunState::Stopped, ExitCode::Stopped, message);
    return ExitCode::Stopped;
}

/// The end of a complete run: done, unless a frame breaks a rule.
ExitCode Simulation::judge() {
    const std::vector<std::string> lines = broken_rules(options_.fail_on, recorder_.statistics());
    for (const std::string& line : lines) {
        spdlog::error("{}: {}", paths_.stats().string(), line);
    }
    const ExitCode code = lines.empty() ? ExitCode::Done : ExitCode::RuleFailed;
    end(RunState::Done, code, lines.empty() ? "" : lines[0]);
    return code;
}

/// Keeps the frames before a divergence, and its last good substep for a look at it.
void Simulation::dump_failure() {
    recorder_.finish();
    write_atomically(paths_.failed_checkpoint(),
                     std::string_view(encode_checkpoint(make_checkpoint(world_, hash_))));
}

/// Writes status.json; where a failure is being told the disk may be its reason, so none is added.
void Simulation::end(RunState state, ExitCode code, const std::string& message) const {
    try {
        write_status(paths_.status(),
                     {.state = state,
                      .frame = state == RunState::Failed ? last_written() : world_.frame,
                      .frames = frames_,
                      .seconds_per_frame = seconds_per_frame_,
                      .exit_code = static_cast<int>(code),
                      .message = message});
    } catch (const Error&) {
        if (state != RunState::Failed) {
            throw;
        }
    }
}

/// The frame that status.json vouches for: after a failure the world may be ahead of the disk.
int Simulation::last_written() const {
    try {
        return read_status(paths_.status()).frame;
    } catch (const Error&) {
        return 0;
    }
}

bool Simulation::should_stop() const {
    return StopSignals::received() != 0 || watch_.seconds() > options_.time_limit;
}

} // namespace

ExitCode simulate(const Scene& scene,
                  const Prepared& start,
                  const RunFolder& folder,
                  const SimulationOptions& options) {
    return Simulation(scene, start, folder.paths(), options).run();
}

} // namespace weft
