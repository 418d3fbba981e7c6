#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// The shortest text that reads back to the same bits; "inf", "-inf" for infinite values.
std::string csv_number(double value);

/// A table of text cells under column names: comma-separated, one header line, no quotes.
struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows; ///< each as long as `columns`

    /// Index of a column, or -1.
    int find_column(std::string_view name) const;

    /// Value of a cell; NaN when it is not a number.
    double number(std::size_t row, int column) const;
};

/// Reads a table. `place` is the file's path, for messages.
/// Throws Error (Disk) in one line when there is no header, a row has another number of cells than
/// the header, or the last line is cut off.
CsvTable parse_csv(std::string_view text, const std::string& place);

/// A table on disk whose first column is the frame: rows are appended as text and the file replaced
/// as a whole, so that it is complete whenever it exists.
class CsvFile {
public:
    /// @param header          names joined by commas
    /// @param previous_header of the version before, whose columns mean the same; "": none
    CsvFile(std::filesystem::path path,
            std::string_view header,
            std::string_view previous_header = "");

    /// Takes the rows of frames up to `last` from the file as it stands on disk; a missing file
    /// gives none. Returns how many. Throws Error (Disk) when its header is neither of the two.
    int keep_rows_through(int last);

    /// Appends a row; a line without its break.
    void add(std::string_view row);

    /// Replaces the file.
    void write() const;

    /// Replaces the file while it is small. Past k_always_write bytes that would cost more than the
    /// frame itself; then only the calls of write() at checkpoints and at the end do.
    void write_if_small() const;

    const std::string& text() const { return text_; }

private:
    static constexpr std::size_t k_always_write = 1U << 20; ///< some 4000 rows of statistics

    std::filesystem::path path_;
    std::string header_;
    std::string previous_header_;
    std::string text_;
};

} // namespace weft
