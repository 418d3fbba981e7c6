#pragma once

#include "app/ordered_worker.h"
#include "app/picture_table.h"
#include "frames/cache.h"
#include "render/renderer.h"

#include <functional>

namespace weft {

/// The range of colours when the scene gives none: for stretch the union of the fabrics' working
/// ranges, else the quantity's own.
Vec2 colour_range(const Scene& scene);

/// What camera, floor and light of a sequence are fitted to.
struct PictureBounds {
    Extent motion;
    bool is_foreseen = true; ///< false: what the cached frames show, as they left what was foreseen
};

/// What a run's pictures are fitted to while it runs, from its first frame on.
Extent foresee_motion(const Frame& first, const Scene& scene);

/// What they are fitted to in the end, from the cached frames and the scene alone: what the first
/// frame foresaw, unless the motion left it by more than a little or filled too little of it.
PictureBounds picture_bounds(const CachedRun& run, const Scene& scene);

/// Draws a frame into a file and gives what there is to tell of the picture.
class PictureWriter {
public:
    PictureWriter(const Scene& scene, const Extent& motion, std::filesystem::path folder);

    /// frame.0001.png ..
    std::filesystem::path file(int frame) const;
    Image draw(const Frame& frame, PictureStats& stats) { return renderer_.draw(frame, &stats); }
    void write(int frame, const Image& image) const;

private:
    Renderer renderer_;
    std::filesystem::path folder_;
};

/// What drawing a run needs to know beside the run.
struct PictureJob {
    std::filesystem::path folder;      ///< for frame.0001.png ..; made when missing
    std::vector<int> frames;           ///< which to draw, ascending
    std::function<bool()> should_stop; ///< asked before each frame
    std::function<void(int)> on_frame; ///< called after each, with how many are drawn
};

/// Draws frames of a run from its cache alone: the same bytes for the same cache and scene. The
/// next frame is drawn while the last one is packed and written. Returns false when it was stopped;
/// what is there by then is complete.
bool draw_run(const CachedRun& run,
              const Scene& scene,
              const Extent& motion,
              const PictureJob& job,
              PictureTable& table);

} // namespace weft
