#include "scene/parse_toml.h"

#include "base/error.h"
#include "scene/key.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace weft {

toml::table parse_toml(std::string_view text, const std::string& place) {
    try {
        return toml::parse(text, place);
    } catch (const toml::parse_error& error) {
        std::string what(error.description());
        std::replace(what.begin(), what.end(), '\n', ' ');
        const toml::source_position at = error.source().begin;
        fail_input("{}:{}:{}: not TOML: {}", place, at.line, at.column, what);
    }
}

namespace {

/// A key, an index or an object's name of the path.
struct Step {
    std::string text;
    std::optional<std::size_t> index;
};

/// `--set KEY=VALUE` taken apart; `option` names it in messages and as the source of its nodes.
struct Assignment {
    std::string option;
    std::vector<Step> steps;
    std::string value;
};

[[noreturn]] void refuse(const Assignment& set, std::string_view what) {
    fail_input("{}: {}", set.option, what);
}

std::optional<std::size_t> as_index(std::string_view text) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    const bool whole = !text.empty() && error == std::errc{} && end == text.data() + text.size();
    return whole ? std::optional(index) : std::nullopt;
}

/// Splits `cloth[0].fabric.bend` at dots and brackets.
std::vector<Step> split_path(const Assignment& set, std::string_view path) {
    std::vector<Step> steps;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= path.size(); ++i) {
        if (i < path.size() && path[i] != '.' && path[i] != '[') {
            continue;
        }
        std::string_view part = path.substr(begin, i - begin);
        if (part.ends_with(']')) {
            part.remove_suffix(1);
            if (!as_index(part)) {
                refuse(set, "an index in brackets must be a number from 0");
            }
        }
        if (part.empty()) {
            refuse(set, "must be KEY=VALUE, as in scene.frames=10 or cloth[0].fabric.bend=1e-5");
        }
        steps.push_back({std::string(part), as_index(part)});
        begin = i + 1;
    }
    return steps;
}

Assignment parse_assignment(const std::string& text) {
    Assignment set{"--set " + text, {}, {}};
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
        refuse(set, "must be KEY=VALUE, as in scene.frames=10");
    }
    set.steps = split_path(set, text.substr(0, equals));
    set.value = text.substr(equals + 1);
    return set;
}

toml::source_region source_of(const Assignment& set) {
    return {{1, 1}, {1, 1}, std::make_shared<const std::string>(set.option)};
}

/// The value as TOML, or else as the string it is, so that names need no quotes.
toml::table parse_value(const Assignment& set) {
    try {
        return toml::parse("value = " + set.value, set.option);
    } catch (const toml::parse_error& error) {
        const bool meant_as_toml =
            set.value.empty() || std::string_view("[{\"'").find(set.value[0]) != std::string::npos;
        if (meant_as_toml) {
            refuse(set, fmt::format("the value is not TOML: {}", error.description()));
        }
    }
    std::string quoted;
    for (const char c : set.value) {
        quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return toml::parse("value = \"" + quoted + '"', set.option);
}

void store(toml::table& table, const Step& step, const Assignment& set) {
    toml::table parsed = parse_value(set);
    parsed.get("value")->visit([&](auto& value) {
        table.erase(step.text);
        table.insert(toml::key(step.text, source_of(set)), std::move(value));
    });
}

void store(toml::array& array, std::size_t index, const Assignment& set) {
    toml::table parsed = parse_value(set);
    parsed.get("value")->visit([&](auto& value) {
        array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(index), std::move(value));
    });
}

/// The element of an array of tables with that index or that `name`.
std::size_t find_element(toml::array& array, const Step& step, const Assignment& set) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < array.size(); ++i) {
        const toml::table* element = array[i].as_table();
        const toml::node* name = element == nullptr ? nullptr : element->get("name");
        names.push_back(name != nullptr && name->is_string() ? name->as_string()->get() : "");
        if (names.back() == step.text) {
            return i;
        }
    }
    if (!step.index) {
        refuse(set, fmt::format("nothing there is named {}; the nearest is {}", step.text,
                                nearest_key(step.text, names)));
    }
    if (*step.index >= array.size()) {
        refuse(set, fmt::format("index {}: must be below {}", *step.index, array.size()));
    }
    return *step.index;
}

/// An empty table that knows where it comes from.
toml::table empty_table(const Assignment& set) {
    toml::table parsed = toml::parse("value = {}", set.option);
    return std::move(*parsed.get("value")->as_table());
}

/// The table under a key, made when it is missing; a fabric's name becomes the table's base.
toml::node& enter(toml::table& table, const Step& step, const Assignment& set) {
    toml::node* next = table.get(step.text);
    if (next == nullptr) {
        if (step.text == "cloth" || step.text == "obstacle" || step.text == "pin") {
            refuse(set, fmt::format("there is no {} there", step.text));
        }
        table.insert(toml::key(step.text, source_of(set)), empty_table(set));
    } else if (step.text == "fabric" && next->is_string()) {
        toml::table with_base = empty_table(set);
        with_base.insert("base", std::move(*next->as_string()));
        table.insert_or_assign(step.text, std::move(with_base));
    }
    return *table.get(step.text);
}

} // namespace

void apply_set(toml::table& root, const std::string& text) {
    const Assignment set = parse_assignment(text);
    toml::node* at = &root;
    for (std::size_t i = 0; i < set.steps.size(); ++i) {
        const Step& step = set.steps[i];
        const bool is_last = i + 1 == set.steps.size();
        if (toml::table* table = at->as_table()) {
            if (is_last) {
                return store(*table, step, set);
            }
            at = &enter(*table, step, set);
        } else if (toml::array* array = at->as_array()) {
            const std::size_t index = find_element(*array, step, set);
            if (is_last) {
                return store(*array, index, set);
            }
            at = array->get(index);
        } else {
            refuse(set, fmt::format("there is nothing below {}", set.steps[i - 1].text));
        }
    }
}

} // namespace weft
