#include "app/picture_table.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/csv.h"

#include <fmt/ranges.h>

namespace weft {

namespace {

CsvFile text_of(const std::filesystem::path& file, const std::map<int, std::string>& rows) {
    CsvFile table(file, images_header());
    for (const auto& [frame, row] : rows) {
        table.add(row);
    }
    return table;
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

} // namespace weft
