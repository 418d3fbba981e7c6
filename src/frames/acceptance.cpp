#include "frames/acceptance.h"

#include "base/error.h"
#include "frames/statistics_columns.h"
#include "scene/key.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

namespace weft {

namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    return text;
}

[[noreturn]] void refuse(std::string_view text) {
    throw Error(
        ExitCode::CommandLine,
        fmt::format("--fail-on {}: must be penetration, retries, or a column of stats.csv with "
                    "<, <=, > or >= and a number, as in stretch_max>1.3",
                    text));
}

/// Gives names that the version before this one wrote their current ones.
class CurrentNames {
public:
    explicit CurrentNames(const Warn& warn) : warn_(warn) {}

    /// @param place where the user named the column, for the warning; one a name
    void take(std::string& column, const std::string& place) {
        const std::string_view now = current_column_name(column);
        if (now != column && warned_.insert(column).second) {
            warn_(fmt::format("{}: the column '{}' of stats.csv is now named '{}': the old name "
                              "will be refused by the next version",
                              place, column, now));
        }
        column = now;
    }

private:
    const Warn& warn_;
    std::set<std::string> warned_;
};

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

bool Rule::is_broken_by(double value) const {
    switch (op) {
    case Op::Less:
        return !(value >= bound);
    case Op::LessEqual:
        return !(value > bound);
    case Op::Greater:
        return !(value <= bound);
    case Op::GreaterEqual:
        return !(value < bound);
    }
    return true;
}

Rule parse_rule(std::string_view text) {
    const std::string_view rule = trimmed(text);
    if (rule == "penetration") {
        return {"unresolved", Rule::Op::Greater, 0.0, "penetration"};
    }
    if (rule == "retries") {
        return {"retries", Rule::Op::Greater, 0.0, "retries"};
    }
    const std::size_t at = rule.find_first_of("<>");
    if (at == std::string_view::npos || at == 0) {
        refuse(text);
    }
    const bool equal = at + 1 < rule.size() && rule[at + 1] == '=';
    const std::string_view number = trimmed(rule.substr(at + (equal ? 2 : 1)));
    Rule result{std::string(trimmed(rule.substr(0, at))), Rule::Op::Greater, 0.0,
                std::string(rule)};
    if (rule[at] == '<') {
        result.op = equal ? Rule::Op::LessEqual : Rule::Op::Less;
    } else {
        result.op = equal ? Rule::Op::GreaterEqual : Rule::Op::Greater;
    }
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), result.bound);
    if (error != std::errc{} || end != number.data() + number.size() ||
        !std::isfinite(result.bound) ||
        result.column.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_") != std::string::npos) {
        refuse(text);
    }
    return result;
}

void check_rules(std::span<Rule> rules, const Warn& warn) {
    const CsvTable table = parse_csv(statistics_header() + "\n", "stats.csv");
    CurrentNames names(warn);
    for (Rule& rule : rules) {
        names.take(rule.column, "--fail-on " + rule.text);
        if (table.find_column(rule.column) < 0) {
            throw Error(ExitCode::CommandLine,
                        fmt::format("--fail-on {}: '{}' is no column of stats.csv; did you mean "
                                    "'{}'?",
                                    rule.text, rule.column,
                                    nearest_key(rule.column, table.columns)));
        }
    }
}

std::vector<std::string> broken_rules(std::span<const Rule> rules, const CsvTable& statistics) {
    std::vector<std::string> lines;
    for (const Rule& rule : rules) {
        const int column = statistics.find_column(rule.column);
        for (std::size_t row = 0; column >= 0 && row < statistics.rows.size(); ++row) {
            if (rule.is_broken_by(statistics.number(row, column))) {
                const auto& cells = statistics.rows[row];
                lines.push_back(fmt::format("frame {}: {} = {}: fails --fail-on {}", cells[0],
                                            rule.column, cells[static_cast<std::size_t>(column)],
                                            rule.text));
                break;
            }
        }
    }
    return lines;
}

void take_current_names(std::span<Expectation> expectations, const Warn& warn) {
    CurrentNames names(warn);
    for (Expectation& expect : expectations) {
        if (expect.file == "stats") {
            names.take(expect.column, expect.place);
        }
    }
}

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
