#include "app/live_pictures.h"

#include <memory>

namespace weft {

LivePictures::LivePictures(const RunPaths& paths, const Scene& scene)
    : paths_(paths), scene_(scene), table_(paths.images()) {}

void LivePictures::keep_through(int last) {
    kept_ = last;
    table_.keep_through(last);
    if (std::filesystem::exists(paths_.images())) {
        table_.write(); // rows of pictures that are not taken over must not be believed again
    }
}

void LivePictures::draw(const Frame& frame) {
    if (!scene_.render.enabled || (frame.number <= kept_ && table_.has(frame.number))) {
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
    auto image = std::make_shared<Image>(writer_->draw(frame, stats));
    packer_.push([this, image, stats, number = frame.number] {
        writer_->write(number, *image);
        table_.put(number, writer_->file(number), stats);
        table_.write_if_small();
    });
}

void LivePictures::release() {
    packer_.finish();
    writer_.reset();
    if (scene_.render.enabled) {
        table_.write();
    }
}

} // namespace weft
