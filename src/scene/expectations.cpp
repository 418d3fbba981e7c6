#include "scene/expectations.h"

#include "base/atomic_file.h"
#include "scene/parse_toml.h"
#include "scene/toml_keys.h"

#include <charconv>

namespace weft {
namespace {

constexpr const char* k_frames_allowed = "must be A-B or A with 1 <= A <= B";

/// "10-50" or "10".
void read_frames(TomlTable& table, Expectation& expect) {
    std::string text;
    if (!table.read("frames", text)) {
        return;
    }
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, expect.first_frame);
    expect.last_frame = expect.first_frame;
    bool good = first.ec == std::errc();
    if (good && first.ptr != end) {
        const auto last = *first.ptr == '-'
                              ? std::from_chars(first.ptr + 1, end, expect.last_frame)
                              : std::from_chars_result{first.ptr, std::errc::invalid_argument};
        good = last.ec == std::errc() && last.ptr == end;
    }
    if (!good || expect.first_frame < 1 || expect.last_frame < expect.first_frame) {
        table.fail("frames", k_frames_allowed);
    }
}

void read_bounds(TomlTable& table, Expectation& expect) {
    const bool has_min = table.read("min", expect.min);
    const bool has_max = table.read("max", expect.max);
    double equals = 0.0;
    double tolerance = 0.0;
    const bool has_equals = table.read("equals", equals);
    const bool has_tolerance = table.read("tolerance", tolerance);
    if (tolerance < 0.0) {
        table.fail("tolerance", "must be >= 0");
    }
    if (has_tolerance && !has_equals) {
        table.fail("tolerance", "needs equals");
    }
    if (has_equals && (has_min || has_max)) {
        table.fail("equals", "must stand without min and max");
    }
    if (!has_min && !has_max && !has_equals) {
        table.fail("needs min, max or equals");
    }
    if (has_equals) {
        expect.min = equals - tolerance;
        expect.max = equals + tolerance;
    }
    if (expect.min > expect.max) {
        table.fail("min", "must not be above max");
    }
}

Keys keys_of(Expectation& expect) {
    return {
        {"file",
         one_of<std::string>(expect.file,
                             {{"stats", "stats"}, {"images", "images"}, {"timing", "timing"}}),
         "", "", "the run's table"},
        {"column", &expect.column, "", "", "a column of the table"},
        {"at",
         one_of(expect.at, {{"each", ExpectAt::Each},
                            {"first", ExpectAt::First},
                            {"last", ExpectAt::Last},
                            {"max", ExpectAt::Max},
                            {"mean", ExpectAt::Mean},
                            {"min", ExpectAt::Min}}),
         "", "", "what of the column is compared"},
    };
}

Expectation read_expectation(TomlTable table, const std::string& file) {
    Expectation expect;
    read_keys(table, keys_of(expect));
    if (!table.has("column")) {
        table.fail("needs column = \"NAME\"");
    }
    read_frames(table, expect);
    read_bounds(table, expect);
    table.finish();
    expect.place = file + ": " + table.path();
    return expect;
}

} // namespace

std::vector<Expectation> read_expectations(const std::filesystem::path& file) {
    const toml::table tree = parse_toml(read_file(file), file.string());
    TomlTable root(tree, "");
    std::vector<Expectation> expectations;
    for (const TomlTable& table : root.tables("expect")) {
        expectations.push_back(read_expectation(table, file.string()));
    }
    root.finish();
    if (expectations.empty()) {
        root.fail("needs an [[expect]]: nothing would be checked");
    }
    return expectations;
}

} // namespace weft
