#include "app/pictures.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/predicted_bounds.h"
#include "render/png.h"

#include <memory>

namespace weft {

namespace {

/// Share of its diagonal by which motion may leave what was foreseen: what the camera's margin
/// takes. Larger: cut off at the rim of the picture; smaller: drawn twice for little.
constexpr double k_beyond = 0.03;
/// The same downwards: cloth below the floor would be hidden by it.
constexpr double k_below = 0.003;
/// Share of the foreseen diagonal below which the pictures are too empty.
constexpr double k_filled = 0.75;

bool was_foreseen(const Extent& motion, const Extent& foreseen) {
    if (foreseen.is_empty() || motion.is_empty()) {
        return foreseen.is_empty() == motion.is_empty();
    }
    const double size = foreseen.box().diagonal().norm();
    return motion.excess_over(foreseen) <= k_beyond * size &&
           motion.excess_below(foreseen) <= k_below * size &&
           motion.box().diagonal().norm() >= k_filled * size;
}

} // namespace

Vec2 colour_range(const Scene& scene) {
    const int index = find_quantity(scene.render.quantity);
    if (scene.render.quantity != "stretch" || scene.cloths.empty()) {
        const Quantity& quantity = k_quantities[static_cast<std::size_t>(std::max(0, index))];
        return {quantity.low, quantity.high};
    }
    Vec2 range = scene.cloths[0].fabric.working_range;
    for (const ClothParams& cloth : scene.cloths) {
        range[0] = std::min(range[0], cloth.fabric.working_range[0]);
        range[1] = std::max(range[1], cloth.fabric.working_range[1]);
    }
    return range;
}

Extent foresee_motion(const Frame& first, const Scene& scene) {
    return predict_bounds(first, scene, subject_objects(first));
}

PictureBounds picture_bounds(const CachedRun& run, const Scene& scene) {
    const std::vector<int> numbers = run.frames();
    if (numbers.empty()) {
        return {};
    }
    const Frame first = run.read(numbers.front());
    const std::vector<bool> counts = subject_objects(first);
    const Extent foreseen = predict_bounds(first, scene, counts);
    Extent motion;
    for (const int number : numbers) {
        const Frame frame = run.read(number);
        for (std::size_t i = 0; i < frame.objects.size(); ++i) {
            if (counts[i]) {
                motion.extend(object_extent(frame.objects[i]));
            }
        }
    }
    const bool is_foreseen = was_foreseen(motion, foreseen);
    return {.motion = is_foreseen ? foreseen : motion, .is_foreseen = is_foreseen};
}

PictureWriter::PictureWriter(const Scene& scene, const Extent& motion, std::filesystem::path folder)
    : renderer_(scene.render, motion, colour_range(scene)), folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
}

std::filesystem::path PictureWriter::file(int frame) const {
    return folder_ / RunPaths{}.picture(frame).filename();
}

void PictureWriter::write(int frame, const Image& image) const {
    write_atomically(file(frame), std::string_view(encode_png(image)));
}

bool draw_run(const CachedRun& run,
              const Scene& scene,
              const Extent& motion,
              const PictureJob& job,
              PictureTable& table) {
    PictureWriter pictures(scene, motion, job.folder);
    OrderedWorker packer(2);
    int drawn = 0;
    for (const int number : job.frames) {
        if (job.should_stop()) {
            packer.finish();
            return false;
        }
        PictureStats stats;
        auto image = std::make_shared<Image>(pictures.draw(run.read(number), stats));
        packer.push([&pictures, &table, image, stats, number] {
            pictures.write(number, *image);
            table.put(number, pictures.file(number), stats);
            table.write_if_small();
        });
        job.on_frame(++drawn);
    }
    packer.finish();
    table.write();
    return true;
}

} // namespace weft
