#include "app/live_pictures.h"

namespace weft {

LivePictures::LivePictures(const RunPaths& paths, const Scene& scene)
    : paths_(paths), scene_(scene), table_(paths.images()) {}

void LivePictures::keep_through(int last) {
    table_.keep_through(last);
    if (std::filesystem::exists(paths_.images())) {
        table_.write(); // rows of pictures that are not taken over must not be believed again
    }
}

void LivePictures::draw(const Frame& frame) {
    if (!scene_.render.enabled || table_.has(frame.number)) {
        return;
    }
    if (!writer_) {
        const CachedRun run(paths_.folder, scene_);
        const std::vector<int> cached = run.frames();
        const bool is_first = cached.empty() || cached.front() >= frame.number;
        const Extent motion = foresee_motion(is_first ? frame : run.read(cached.front()), scene_);
        writer_.emplace(scene_, motion, paths_.frames_dir());
    }
    PictureStats stats;
    writer_->write(frame.number, writer_->draw(frame, stats));
    table_.put(frame.number, writer_->file(frame.number), stats);
    table_.write_if_small();
}

void LivePictures::release() {
    writer_.reset();
    if (scene_.render.enabled) {
        table_.write();
    }
}

} // namespace weft
