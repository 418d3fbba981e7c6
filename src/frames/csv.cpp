#include "frames/csv.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <limits>

namespace weft {

namespace {

std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> cells;
    for (std::size_t begin = 0;;) {
        const std::size_t end = line.find(',', begin);
        cells.emplace_back(line.substr(begin, end - begin));
        if (end == std::string_view::npos) {
            return cells;
        }
        begin = end + 1;
    }
}

/// The number before the first comma, or 0.
int leading_frame(std::string_view line) {
    int frame = 0;
    std::from_chars(line.data(), line.data() + line.size(), frame);
    return frame;
}

} // namespace

std::string csv_number(double value) {
    return fmt::format("{}", value);
}

int CsvTable::find_column(std::string_view name) const {
    const auto at = std::find(columns.begin(), columns.end(), name);
    return at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
}

double CsvTable::number(std::size_t row, int column) const {
    const std::string& cell = rows[row][static_cast<std::size_t>(column)];
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool whole = error == std::errc() && end == cell.data() + cell.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

CsvTable parse_csv(std::string_view text, const std::string& place) {
    if (text.empty() || text.back() != '\n') {
        fail_disk("{}: must be a table of whole lines under a header", place);
    }
    CsvTable table;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        std::vector<std::string> cells = split(text.substr(begin, end - begin));
        begin = end + 1;
        if (table.columns.empty()) {
            table.columns = std::move(cells);
        } else if (cells.size() == table.columns.size()) {
            table.rows.push_back(std::move(cells));
        } else {
            fail_disk("{}:{}: {} cells: must be {} as in the header", place, table.rows.size() + 2,
                      cells.size(), table.columns.size());
        }
    }
    return table;
}

CsvFile::CsvFile(std::filesystem::path path,
                 std::string_view header,
                 std::string_view previous_header)
    : path_(std::move(path)), header_(header), previous_header_(previous_header),
      text_(header_ + "\n") {}

int CsvFile::keep_rows_through(int last) {
    text_ = header_ + "\n";
    if (!std::filesystem::exists(path_)) {
        return 0;
    }
    const std::string old = read_file(path_);
    const bool is_current = old.starts_with(text_);
    if (!is_current && (previous_header_.empty() || !old.starts_with(previous_header_ + "\n"))) {
        fail_disk("{}: has other columns than this version of weft writes: --overwrite starts the "
                  "run again",
                  path_.string());
    }
    int kept = 0;
    for (std::size_t begin = (is_current ? header_ : previous_header_).size() + 1;
         begin < old.size();) {
        const std::size_t end = std::min(old.find('\n', begin), old.size() - 1);
        const std::string_view line(old.data() + begin, end - begin);
        if (leading_frame(line) <= last) {
            add(line);
            ++kept;
        }
        begin = end + 1;
    }
    return kept;
}

void CsvFile::add(std::string_view row) {
    assert(std::count(row.begin(), row.end(), ',') ==
           std::count(header_.begin(), header_.end(), ','));
    text_.append(row).push_back('\n');
}

void CsvFile::write() const {
    write_atomically(path_, text_);
}

void CsvFile::write_if_small() const {
    if (text_.size() < k_always_write) {
        write();
    }
}

} // namespace weft
