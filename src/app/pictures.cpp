#include "app/pictures.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/csv.h"
#include "frames/predicted_bounds.h"
#include "render/image.h"

#include <fmt/ranges.h>

#include <memory>

namespace weft {

namespace {

CsvFile text_of(const std::filesystem::path& file, const std::map<int, std::string>& rows) {
    CsvFile table(file, images_header());
    for (const auto& [frame, row] : rows) {
        table.add(row);
    }
    return table;
}

/// Fraction of the diagonal by which motion may leave the predicted bounds: what the camera's
/// margin takes. Larger: cut off at the rim of the picture; smaller: drawn twice for little.
constexpr double k_beyond = 0.03;
/// The same downwards: cloth below the floor would be hidden by it.
constexpr double k_below = 0.003;
/// Fraction of the predicted diagonal below which the pictures are too empty.
constexpr double k_filled = 0.75;

bool fits_prediction(const Extent& motion, const Extent& predicted) {
    if (predicted.is_empty() || motion.is_empty()) {
        return predicted.is_empty() == motion.is_empty();
    }
    const double size = predicted.box().diagonal().norm();
    return motion.excess_over(predicted) <= k_beyond * size &&
           motion.excess_below(predicted) <= k_below * size &&
           motion.box().diagonal().norm() >= k_filled * size;
}

} // namespace

std::string_view images_header() {
    return "frame,file,covered_share,above_share,below_share,mean_red,mean_green,mean_blue";
}

void PictureTable::keep_through(int last) {
    CsvTable old;
    try {
        old = parse_csv(read_file(file_), file_.string());
    } catch (const Error&) {
        return;
    }
    if (fmt::format("{}", fmt::join(old.columns, ",")) != images_header()) {
        return;
    }
    for (std::size_t row = 0; row < old.rows.size(); ++row) {
        const int frame = static_cast<int>(old.number(row, 0));
        if (frame <= last && std::filesystem::exists(file_.parent_path() / old.rows[row][1])) {
            rows_[frame] = fmt::format("{}", fmt::join(old.rows[row], ","));
        }
    }
}

void PictureTable::put(int frame, const std::filesystem::path& picture, const PictureStats& stats) {
    const auto shown = std::filesystem::proximate(picture, file_.parent_path());
    rows_[frame] = fmt::format("{},{},{},{},{},{},{},{}", frame, shown.generic_string(),
                               csv_number(stats.covered_share), csv_number(stats.above_share),
                               csv_number(stats.below_share), csv_number(stats.mean_colour[0]),
                               csv_number(stats.mean_colour[1]), csv_number(stats.mean_colour[2]));
}

void PictureTable::write() const {
    text_of(file_, rows_).write();
}

void PictureTable::write_if_small() const {
    text_of(file_, rows_).write_if_small();
}

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

Extent predict_picture_bounds(const Frame& first, const Scene& scene) {
    return predict_bounds(first, scene, subject_objects(first));
}

PictureBounds picture_bounds(const CachedRun& run, const Scene& scene) {
    const std::vector<int> numbers = run.frames();
    if (numbers.empty()) {
        return {};
    }
    const Frame first = run.read(numbers.front());
    const std::vector<bool> counts = subject_objects(first);
    const Extent predicted = predict_bounds(first, scene, counts);
    Extent motion;
    for (const int number : numbers) {
        const Frame frame = run.read(number);
        for (std::size_t i = 0; i < frame.objects.size(); ++i) {
            if (counts[i]) {
                motion.extend(object_extent(frame.objects[i]));
            }
        }
    }
    const bool is_as_predicted = fits_prediction(motion, predicted);
    return {.motion = is_as_predicted ? predicted : motion, .is_as_predicted = is_as_predicted};
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
        const Extent motion =
            predict_picture_bounds(is_first ? frame : run.read(cached.front()), scene_);
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
