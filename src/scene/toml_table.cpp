#include "scene/toml_table.h"

#include "base/error.h"
#include "scene/key.h"
#include "scene/scene_reader.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

namespace weft {
namespace {

/// Numbers in their shortest form, which toml++ does not give.
std::string whole_text_of(const toml::node& node) {
    if (const toml::array* array = node.as_array()) {
        std::string list;
        for (const toml::node& element : *array) {
            list += (list.empty() ? "" : ", ") + whole_text_of(element);
        }
        return '[' + list + ']';
    }
    if (node.is_table()) {
        return "{...}";
    }
    if (const toml::value<double>* number = node.as_floating_point()) {
        return fmt::format("{}", number->get());
    }
    std::ostringstream stream;
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) {
            stream << toml::toml_formatter{value, toml::format_flags::none};
        }
    });
    return stream.str();
}

/// Where a node stands: `shirt.toml:12:9`, or `--set KEY=VALUE` when it came from there.
std::string place_of(const toml::source_region& source) {
    const std::string file = source.path ? *source.path : "scene";
    if (file.starts_with("--set ") || file == k_command_line_place) {
        return file;
    }
    return fmt::format("{}:{}:{}", file, source.begin.line, source.begin.column);
}

/// A value as the user would write it, on one line, shortened when long.
std::string text_of(const toml::node& node) {
    std::string text = whole_text_of(node);
    std::replace(text.begin(), text.end(), '\n', ' ');
    constexpr std::size_t k_longest = 60;
    if (text.size() > k_longest) {
        text.resize(k_longest);
        text += "...";
    }
    return text;
}

/// Throws `place: path = value: what`.
[[noreturn]] void fail_at(const toml::node& node, const std::string& path, std::string_view what) {
    fail_input("{}: {} = {}: {}", place_of(node.source()), path, text_of(node), what);
}

/// A finite number; an integer counts as one.
double number_at(const toml::node& node, const std::string& path) {
    if (!node.is_number()) {
        fail_at(node, path, "must be a number");
    }
    const double value = node.value<double>().value_or(std::nan(""));
    if (!std::isfinite(value)) {
        fail_at(node, path, "must be finite");
    }
    return value;
}

/// An integer that fits an int.
int integer_at(const toml::node& node, const std::string& path) {
    const auto value = node.value_exact<std::int64_t>();
    if (!value) {
        fail_at(node, path, "must be an integer");
    }
    constexpr std::int64_t k_most = std::numeric_limits<int>::max();
    if (*value > k_most || *value < -k_most) {
        fail_at(node, path, "must be an integer of at most 2147483647");
    }
    return static_cast<int>(*value);
}

/// An array, of `size` elements when that is not 0; `of_what` names them in the message.
const toml::array&
array_at(const toml::node& node, const std::string& path, std::size_t size, const char* of_what) {
    const toml::array* array = node.as_array();
    if (array == nullptr || (size > 0 && array->size() != size)) {
        const std::string count = size > 0 ? fmt::format("{} ", size) : "";
        fail_at(node, path, fmt::format("must be an array of {}{}", count, of_what));
    }
    return *array;
}

std::string element_path(const std::string& path, std::size_t i) {
    return fmt::format("{}[{}]", path, i);
}

std::string quoted_list(const std::vector<std::string>& words) {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i) {
        list += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
        list += '"' + words[i] + '"';
    }
    return list;
}

} // namespace

TomlTable::TomlTable(const toml::table& table, std::string path)
    : table_(&table), path_(std::move(path)) {}

std::string TomlTable::path_to(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const toml::node* TomlTable::find(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
        known_.emplace_back(key);
    }
    return table_->get(key);
}

bool TomlTable::has(std::string_view key) {
    return find(key) != nullptr;
}

bool TomlTable::is_string(std::string_view key) {
    return has(key) && find(key)->is_string();
}

bool TomlTable::is_table(std::string_view key) {
    return has(key) && find(key)->is_table();
}

bool TomlTable::is_array(std::string_view key) {
    return has(key) && find(key)->is_array();
}

bool TomlTable::read(std::string_view key, bool& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    if (!node->is_boolean()) {
        fail_at(*node, path_to(key), "must be true or false");
    }
    value = node->as_boolean()->get();
    return true;
}

bool TomlTable::read(std::string_view key, int& value) {
    const toml::node* node = find(key);
    if (node != nullptr) {
        value = integer_at(*node, path_to(key));
    }
    return node != nullptr;
}

bool TomlTable::read(std::string_view key, double& value) {
    const toml::node* node = find(key);
    if (node != nullptr) {
        value = number_at(*node, path_to(key));
    }
    return node != nullptr;
}

bool TomlTable::read(std::string_view key, std::string& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    if (!node->is_string()) {
        fail_at(*node, path_to(key), "must be a string");
    }
    value = node->as_string()->get();
    return true;
}

template <typename V>
bool TomlTable::read_vector(std::string_view key, V& value, std::size_t size) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    const std::string path = path_to(key);
    const toml::array& array = array_at(*node, path, size, "numbers");
    for (std::size_t i = 0; i < size; ++i) {
        value[static_cast<Eigen::Index>(i)] = number_at(array[i], element_path(path, i));
    }
    return true;
}

bool TomlTable::read(std::string_view key, Vec2& value) {
    return read_vector(key, value, 2);
}

bool TomlTable::read(std::string_view key, Vec3& value) {
    return read_vector(key, value, 3);
}

bool TomlTable::read(std::string_view key, std::array<int, 2>& value) {
    std::vector<int> read_values;
    if (!read(key, read_values)) {
        return false;
    }
    array_at(*find(key), path_to(key), 2, "integers");
    std::copy(read_values.begin(), read_values.end(), value.begin());
    return true;
}

bool TomlTable::read(std::string_view key, std::vector<int>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    const std::string path = path_to(key);
    const toml::array& array = array_at(*node, path, 0, "integers");
    value.clear();
    for (std::size_t i = 0; i < array.size(); ++i) {
        value.push_back(integer_at(array[i], element_path(path, i)));
    }
    return true;
}

bool TomlTable::read(std::string_view key, std::vector<std::array<double, 4>>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    const std::string path = path_to(key);
    const toml::array& rows = array_at(*node, path, 0, "rows of 4 numbers");
    value.assign(rows.size(), {});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string row_path = element_path(path, i);
        const toml::array& row = array_at(rows[i], row_path, 4, "numbers");
        for (std::size_t k = 0; k < 4; ++k) {
            value[i][k] = number_at(row[k], element_path(row_path, k));
        }
    }
    return true;
}

bool TomlTable::read(std::string_view key, std::vector<std::string>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        return false;
    }
    if (node->is_string()) {
        value = {node->as_string()->get()};
        return true;
    }
    const std::string path = path_to(key);
    if (!node->is_array()) {
        fail_at(*node, path, "must be a string or an array of strings");
    }
    value.clear();
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_string()) {
            fail_at(element, element_path(path, value.size()), "must be a string");
        }
        value.push_back(element.as_string()->get());
    }
    return true;
}

int TomlTable::read_word(std::string_view key, const std::vector<std::string>& words) {
    std::string word;
    if (!read(key, word)) {
        return -1;
    }
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        fail(key, "must be " + quoted_list(words));
    }
    return static_cast<int>(found - words.begin());
}

TomlTable TomlTable::table(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) {
        fail(fmt::format("needs {}", key));
    }
    if (!node->is_table()) {
        fail_at(*node, path_to(key), "must be a table");
    }
    return {*node->as_table(), path_to(key)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
    const toml::node* node = find(key);
    std::vector<TomlTable> found;
    if (node == nullptr) {
        return found;
    }
    const std::string path = path_to(key);
    if (!node->is_array()) {
        fail_at(*node, path, fmt::format("must be an array of tables: write [[{}]]", key));
    }
    const toml::array& array = *node->as_array();
    for (std::size_t i = 0; i < array.size(); ++i) {
        if (!array[i].is_table()) {
            fail_at(array[i], element_path(path, i), "must be a table");
        }
        found.emplace_back(*array[i].as_table(), element_path(path, i));
    }
    return found;
}

void TomlTable::refuse(const std::string& problem) const {
    if (problem.empty()) {
        return;
    }
    std::string key = problem.substr(0, problem.find_first_of(" :="));
    const toml::node* node = table_->at_path(key).node();
    while (node == nullptr && !key.empty()) {
        const std::size_t last = key.find_last_of(".[");
        key.resize(last == std::string::npos ? 0 : last);
        node = key.empty() ? nullptr : table_->at_path(key).node();
    }
    const toml::source_region& source = node != nullptr ? node->source() : table_->source();
    fail_input("{}: {}", place_of(source), path_to(problem));
}

void TomlTable::fail(std::string_view key, std::string_view what) const {
    const toml::node* node = table_->get(key);
    if (node == nullptr) {
        fail_input("{}: {}: {}", place_of(table_->source()), path_to(key), what);
    }
    fail_at(*node, path_to(key), what);
}

void TomlTable::fail(std::string_view what) const {
    if (path_.empty()) {
        fail_input("{}: {}", place_of(table_->source()), what);
    }
    fail_input("{}: {}: {}", place_of(table_->source()), path_, what);
}

void TomlTable::finish() const {
    const toml::key* first = nullptr;
    for (const auto& entry : *table_) {
        const toml::key& key = entry.first;
        const bool known = std::find(known_.begin(), known_.end(), key.str()) != known_.end();
        if (!known && (first == nullptr || key.source().begin < first->source().begin)) {
            first = &key;
        }
    }
    if (first != nullptr) {
        fail_input("{}: {}: unknown key; the nearest is {}", place_of(first->source()),
                   path_to(first->str()), nearest_key(first->str(), known_));
    }
}

} // namespace weft
