#pragma once

#include "app/pictures.h"

#include <optional>

namespace weft {

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
