#include "app/pictures.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "render/png.h"

#include <memory>

namespace weft {

std::string_view images_header() {
    return "frame,file,covered_share,above_share,below_share,mean_red,mean_green,mean_blue";
}

std::string images_row(int frame, const std::string& file, const PictureStats& stats) {
    return fmt::format("{},{},{},{},{},{},{},{}", frame, file, csv_number(stats.covered_share),
                       csv_number(stats.above_share), csv_number(stats.below_share),
                       csv_number(stats.mean_colour[0]), csv_number(stats.mean_colour[1]),
                       csv_number(stats.mean_colour[2]));
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

Box3 run_bounds(const CachedRun& run) {
    Box3 bounds;
    for (const int number : run.frames()) {
        bounds.extend(subject_bounds(run.read(number)));
    }
    return bounds;
}

bool draw_run(const CachedRun& run, const Scene& scene, const PictureJob& job) {
    std::filesystem::create_directories(job.folder);
    Renderer renderer(scene.render, run_bounds(run), colour_range(scene));
    CsvFile table(job.table, images_header());
    OrderedWorker writer(2);
    int drawn = 0;
    for (const int number : job.frames) {
        if (job.should_stop()) {
            writer.finish();
            return false;
        }
        PictureStats stats;
        auto image = std::make_shared<Image>(renderer.draw(run.read(number), &stats));
        writer.push([&table, &job, image, stats, number] {
            const auto file = RunPaths{job.folder}.picture(number).filename();
            write_atomically(job.folder / file, std::string_view(encode_png(*image)));
            const auto shown =
                std::filesystem::proximate(job.folder / file, job.table.parent_path());
            table.add(images_row(number, shown.generic_string(), stats));
            table.write_if_small();
        });
        job.on_frame(++drawn);
    }
    writer.finish();
    table.write();
    return true;
}

} // namespace weft
