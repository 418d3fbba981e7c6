#include "frames/rule.h"

#include "base/error.h"

#include <charconv>
#include <cmath>

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

} // namespace weft
