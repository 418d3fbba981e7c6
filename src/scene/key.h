#pragma once

#include "scene/params.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// How a key of the scene file is described. One row says all that the program knows of the key:
/// the reader, the check of its range, the writer and the pages about keys go through the same
/// rows.
namespace weft {

/// What a number may be, in the words that follow "must be" in a refusal. The words are the check:
/// the bounds are read from them, so that the two cannot differ.
struct Range {
    std::string text;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool is_low_open = false; ///< `low` itself is refused
    bool is_high_open = false;

    /// `> 0`, `>= 0 and < 1`, `1 to 100` or `0 to below 1`; a comma begins an explanation.
    Range(const char* words);
    /// A range whose bound is the value of another key, which `words` name.
    Range(std::string words, double least, double most)
        : text(std::move(words)), low(least), high(most) {}

    bool holds(double value) const;
    /// The words without their explanation; empty: any number.
    std::string short_text() const { return text.substr(0, text.find(',')); }
};

Range any_number();
Range more_than(double bound, std::string words);
Range at_least(double bound, std::string words);
Range at_most(double bound, std::string words);

/// The range of each component of a value, or one for all of them.
class Ranges {
public:
    /// "": any value.
    Ranges(const char* words) {
        if (*words != '\0') {
            each_.emplace_back(words);
        }
    }
    Ranges(Range range) : each_{std::move(range)} {}
    Ranges(std::vector<Range> each) : each_(std::move(each)) {}

    bool empty() const { return each_.empty(); }
    const std::vector<Range>& each() const { return each_; }
    const Range& of_component(std::size_t i) const { return each_[std::min(i, each_.size() - 1)]; }

private:
    std::vector<Range> each_;
};

/// One of some words, each for a value of an enumeration.
struct Words {
    std::vector<std::string> words;
    std::function<int()> chosen; ///< index of the word for the value; -1: none stands for it
    std::function<void(int)> choose;
};

template <typename E> Words one_of(E& value, std::vector<std::pair<std::string, E>> choices) {
    Words words;
    for (const auto& choice : choices) {
        words.words.push_back(choice.first);
    }
    words.chosen = [&value, choices] {
        for (std::size_t i = 0; i < choices.size(); ++i) {
            if (choices[i].second == value) {
                return static_cast<int>(i);
            }
        }
        return -1;
    };
    words.choose = [&value, choices](int i) {
        value = choices[static_cast<std::size_t>(i)].second;
    };
    return words;
}

/// The path of a file, relative to the scene.
struct Path {
    std::string* file;
};

/// The unit of a mesh file: metres per unit, or a word for them.
struct Units {
    double* metres;
};

/// A boundary loop: its number, or the side on which it lies.
struct Loop {
    int* number;
    std::string* side;
};

/// A key whose value the reader and the writer handle by themselves.
struct Elsewhere {};

struct Key;
using Keys = std::vector<Key>;

/// A table that is written on one line, `{ min = [..], max = [..] }`.
struct Inline {
    Keys keys;
};

/// Where the value of a key is kept.
using Value = std::variant<bool*,
                           int*,
                           double*,
                           std::string*,
                           Vec2*,
                           Vec3*,
                           std::array<int, 2>*,
                           std::array<std::string, 2>*,
                           std::vector<int>*,
                           std::vector<std::string>*,
                           std::vector<std::array<double, 4>>*,
                           std::vector<PoseKey>*,
                           std::optional<double>*,
                           std::optional<Vec3>*,
                           std::optional<VertexChoice>*,
                           Words,
                           Path,
                           Units,
                           Loop,
                           Inline,
                           Elsewhere>;

/// One key of a table of the scene file, bound to where its value is kept.
struct Key {
    std::string name;
    Value value;                ///< holds the default until the key is read
    std::string unit;           ///< empty: none
    Ranges ranges;              ///< what the value may be
    std::string meaning;        ///< what the value does, for the pages about keys
    std::string note{};         ///< behind the value in a written scene; empty: the unit
    std::string default_text{}; ///< what holds without the key; empty: `value` says it

    bool is_read = true;    ///< false: the table does not know it, or reads it by itself
    bool is_checked = true; ///< false: the ranges do not hold now
    bool is_written = true; ///< false: a written scene leaves it out

    Key read_if(bool condition) &&;
    Key checked_if(bool condition) &&;
    Key written_if(bool condition) &&;

    /// What a range allows, with the unit where the words end in a number.
    std::string allowed(const Range& range) const;
};

Keys operator+(Keys a, const Keys& b);

/// The first value out of its range, as `key = value: must be ...`; "" when all is well.
std::string problem_of(const Keys& keys);

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours; case counts
/// half) to `word`; the earlier one of equals; "" for no candidates.
std::string nearest_key(std::string_view word, std::span<const std::string> candidates);

} // namespace weft
