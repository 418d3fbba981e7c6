#pragma once

#include "app/ordered_worker.h"
#include "frames/cache.h"
#include "frames/csv.h"
#include "render/renderer.h"

#include <functional>

namespace weft {

/// Names of the columns of images.csv, joined by commas.
std::string_view images_header();

/// A row of images.csv. `file` as it stands relative to the table.
std::string images_row(int frame, const std::string& file, const PictureStats& stats);

/// The range of colours when the scene gives none: for stretch the union of the fabrics' working
/// ranges, else the quantity's own.
Vec2 colour_range(const Scene& scene);

/// Box of what a whole run moves in; one pass over its cache.
Box3 run_bounds(const CachedRun& run);

/// What drawing a run needs to know beside the run.
struct PictureJob {
    std::filesystem::path folder;      ///< for frame.0001.png ..; made when missing
    std::filesystem::path table;       ///< images.csv
    std::vector<int> frames;           ///< which to draw, ascending
    std::function<bool()> should_stop; ///< asked before each frame
    std::function<void(int)> on_frame; ///< called after each, with how many are drawn
};

/// Draws frames of a run from its cache alone: the same bytes for the same cache and scene. Camera,
/// floor and light are fitted to the motion of all cached frames, so pictures come when the motion
/// is known. The next frame is drawn while the last one is packed and written. Returns false when
/// it was stopped; what is there by then is complete.
bool draw_run(const CachedRun& run, const Scene& scene, const PictureJob& job);

} // namespace weft
