#pragma once

#include "app/ordered_worker.h"
#include "frames/cache.h"
#include "frames/run_folder.h"
#include "render/renderer.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// Names of the columns of images.csv, joined by commas.
std::string_view images_header();

/// images.csv: a row a picture, by ascending frame in whatever order they are drawn.
class PictureTable {
public:
    explicit PictureTable(std::filesystem::path file) : file_(std::move(file)) {}

    /// Takes the rows of frames up to `last` from the file as it stands, of those whose picture is
    /// there; a file that is missing or no such table has none.
    void keep_through(int last);
    bool has(int frame) const { return rows_.contains(frame); }

    /// @param picture its file; the table names it relative to itself
    void put(int frame, const std::filesystem::path& picture, const PictureStats& stats);

    void write() const;
    /// As CsvFile::write_if_small.
    void write_if_small() const;
    const std::filesystem::path& file() const { return file_; }

private:
    std::filesystem::path file_;
    std::map<int, std::string> rows_;
};

/// The range of colours when the scene gives none: for stretch the union of the fabrics' working
/// ranges, else the quantity's own.
Vec2 colour_range(const Scene& scene);

/// What camera, floor and light of a sequence are fitted to.
struct PictureBounds {
    Extent motion;
    bool is_as_predicted =
        true; ///< false: what the cached frames show, as they left the predicted bounds
};

/// What a run's pictures are fitted to while it runs, from its first frame on.
Extent predict_picture_bounds(const Frame& first, const Scene& scene);

/// What they are fitted to in the end, from the cached frames and the scene alone: the bounds
/// predicted from the first frame, unless the motion left them by more than a little or filled too
/// little of it.
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

/// Pictures of a run that goes on, each drawn when its frame is there and packed while the next one
/// is drawn. All calls but the first two
/// come from one thread at a time; draw() and release() from the same one, as OpenGL asks.
class LivePictures {
public:
    LivePictures(const RunPaths& paths, const Scene& scene);

    /// Takes over the pictures of a stopped run up to frame `last`; 0: none.
    void keep_through(int last);

    /// Draws a frame, unless its picture is there. Nothing when the scene wants no pictures.
    void draw(const Frame& frame);

    /// Gives OpenGL back and completes the table.
    void release();

    /// To be asked after release().
    PictureTable& table() { return table_; }

private:
    RunPaths paths_;
    const Scene& scene_;
    int kept_ = 0;                        ///< last frame whose picture may have been taken over
    PictureTable table_;                  ///< the packer's own while it works
    std::optional<PictureWriter> writer_; ///< from the first frame that is drawn
    OrderedWorker packer_{2};             ///< last: its jobs use the others
};

} // namespace weft
