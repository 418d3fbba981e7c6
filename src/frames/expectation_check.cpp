#include "frames/expectation_check.h"

#include "base/error.h"
#include "scene/nearest_key.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft {

namespace {

/// One number to compare and the words that say where it is from.
struct Sample {
    std::string from;
    double value;
};

std::vector<Sample> samples_in_range(const Expectation& expect, const CsvTable& table, int column) {
    std::vector<Sample> samples;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double frame = table.number(row, 0);
        if (frame >= expect.first_frame && frame <= expect.last_frame) {
            samples.push_back({"frame " + table.rows[row][0], table.number(row, column)});
        }
    }
    return samples;
}

/// NaN counts as worse than any number, so that it is never passed over.
bool is_less(const Sample& a, const Sample& b) {
    return a.value < b.value;
}

/// What the expectation looks at: all samples, or the one that sums them up.
std::vector<Sample> select(ExpectAt at, const std::vector<Sample>& samples) {
    const auto bad = std::find_if(samples.begin(), samples.end(),
                                  [](const Sample& s) { return std::isnan(s.value); });
    if (at == ExpectAt::Each) {
        return samples;
    }
    if (at == ExpectAt::First) {
        return {samples.front()};
    }
    if (at == ExpectAt::Last) {
        return {samples.back()};
    }
    if (bad != samples.end()) {
        return {*bad};
    }
    if (at == ExpectAt::Max) {
        const Sample& most = *std::max_element(samples.begin(), samples.end(), is_less);
        return {{"max, " + most.from, most.value}};
    }
    if (at == ExpectAt::Min) {
        const Sample& least = *std::min_element(samples.begin(), samples.end(), is_less);
        return {{"min, " + least.from, least.value}};
    }
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0,
                                       [](double s, const Sample& v) { return s + v.value; });
    return {{"mean", sum / static_cast<double>(samples.size())}};
}

std::string bounds_text(const Expectation& expect) {
    if (!std::isfinite(expect.min)) {
        return fmt::format("must be <= {}", expect.max);
    }
    if (!std::isfinite(expect.max)) {
        return fmt::format("must be >= {}", expect.min);
    }
    return fmt::format("must be {} to {}", expect.min, expect.max);
}

} // namespace

std::string find_miss(const Expectation& expect, const CsvTable& table, const std::string& name) {
    const int column = table.find_column(expect.column);
    if (column < 0) {
        fail_input("{}.column = \"{}\": is no column of {}; did you mean '{}'?", expect.place,
                   expect.column, name, nearest_key(expect.column, table.columns));
    }
    const std::vector<Sample> samples = samples_in_range(expect, table, column);
    if (samples.empty()) {
        return fmt::format("{}: {}: no frames in the range: must have some", expect.place, name);
    }
    for (const Sample& sample : select(expect.at, samples)) {
        if (!(sample.value >= expect.min && sample.value <= expect.max)) {
            return fmt::format("{}: {}: {}: {} = {}: {}", expect.place, name, sample.from,
                               expect.column, sample.value, bounds_text(expect));
        }
    }
    return "";
}

} // namespace weft
