#pragma once

#include "frames/run_folder.h"
#include "render/picture_stats.h"

#include <map>
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

} // namespace weft
