#include "scene/toml_keys.h"

#include "scene/scene_keys.h"

#include <fmt/core.h>

#include <cmath>

namespace weft {
namespace {

/// Reads one key; the value under it may be missing.
class KeyReader {
public:
    KeyReader(TomlTable& table, const std::string& name) : table_(table), name_(name) {}

    template <typename T> void operator()(T* value) { table_.read(name_, *value); }
    void operator()(std::optional<double>* value) { read_optional(*value); }
    void operator()(std::optional<Vec3>* value) { read_optional(*value); }
    void operator()(std::array<std::string, 2>* value);
    void operator()(std::vector<PoseKey>* value);
    void operator()(std::optional<VertexChoice>* value);
    void operator()(const Words& value);
    void operator()(const Path& value) { table_.read(name_, *value.file); }
    void operator()(const Units& value);
    void operator()(const Loop& value);
    void operator()(const Inline& value);
    void operator()(const Elsewhere&) { table_.has(name_); }

private:
    template <typename T> void read_optional(std::optional<T>& value) {
        if (table_.has(name_)) {
            table_.read(name_, value.emplace());
        }
    }

    TomlTable& table_;
    const std::string& name_;
};

void KeyReader::operator()(std::array<std::string, 2>* value) {
    std::vector<std::string> names;
    table_.read(name_, names);
    if (names.size() != 2) {
        table_.fail(name_, "must be the names of two objects");
    }
    *value = {names[0], names[1]};
}

void KeyReader::operator()(std::vector<PoseKey>* value) {
    for (TomlTable& table : table_.tables(name_)) {
        PoseKey pose;
        read_keys(table, keys_of(pose));
        table.finish();
        if (!table.has("t")) {
            table.fail("needs t, the time in s");
        }
        value->push_back(pose);
    }
}

void KeyReader::operator()(std::optional<VertexChoice>* value) {
    if (!table_.has(name_)) {
        return;
    }
    VertexChoice choice;
    if (table_.is_array(name_)) {
        table_.read(name_, choice.place);
    } else {
        table_.read(name_, choice.vertex);
        if (choice.vertex < 0) {
            table_.fail(name_, "must be >= 0, the index of a vertex, or a place [x, y, z]");
        }
    }
    *value = choice;
}

void KeyReader::operator()(const Words& value) {
    const int found = table_.read_word(name_, value.words);
    if (found >= 0) {
        value.choose(found);
    }
}

void KeyReader::operator()(const Units& value) {
    if (!table_.is_string(name_)) {
        table_.read(name_, *value.metres);
        return;
    }
    const double metres[] = {1.0, 0.01, 0.001, 0.0254};
    *value.metres = metres[table_.read_word(name_, {"m", "cm", "mm", "in"})];
}

void KeyReader::operator()(const Loop& value) {
    if (table_.is_string(name_)) {
        table_.read_word(name_, {"top", "bottom"});
        table_.read(name_, *value.side);
    } else if (table_.read(name_, *value.number) && *value.number < 0) {
        table_.fail(name_, "must be >= 0 (0: the longest), \"top\" or \"bottom\"");
    }
}

void KeyReader::operator()(const Inline& value) {
    if (table_.has(name_)) {
        TomlTable table = table_.table(name_);
        read_keys(table, value.keys);
        table.finish();
    }
}

/// The value of one key as TOML; nothing where it is empty or without end.
class KeyWriter {
public:
    using Text = std::optional<std::string>;

    explicit KeyWriter(const PathText& path_text) : path_text_(path_text) {}

    template <typename T> Text operator()(T* value) { return TomlWriter::toml_text(*value); }
    template <typename T> Text operator()(std::vector<T>* value) {
        return value->empty() ? Text() : TomlWriter::toml_text(*value);
    }
    template <typename T> Text operator()(std::optional<T>* value) {
        return *value ? (*this)(&**value) : Text();
    }
    Text operator()(double* value) {
        return std::isfinite(*value) ? Text(TomlWriter::toml_text(*value)) : Text();
    }
    Text operator()(std::string* value) {
        return value->empty() ? Text() : TomlWriter::toml_text(*value);
    }
    Text operator()(VertexChoice* value) {
        return value->vertex == k_no_index ? (*this)(&value->place) : (*this)(&value->vertex);
    }
    Text operator()(std::vector<PoseKey>* value);
    Text operator()(const Words& value) {
        const int chosen = value.chosen();
        return chosen < 0 ? Text() : TomlWriter::toml_text(value.words[at(chosen)]);
    }
    Text operator()(const Path& value) {
        return value.file->empty() ? Text() : TomlWriter::toml_text(path_text_(*value.file));
    }
    Text operator()(const Units& value) { return (*this)(value.metres); }
    Text operator()(const Loop& value) {
        return *value.number >= 0 ? (*this)(value.number) : (*this)(value.side);
    }
    Text operator()(const Inline& value) { return "{ " + inside_text(value.keys) + " }"; }
    Text operator()(const Elsewhere&) { return {}; }

private:
    std::string inside_text(const Keys& keys) {
        std::string text;
        for (const Key& key : keys) {
            if (const Text value = value_text(key, path_text_)) {
                text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.name, *value);
            }
        }
        return text;
    }

    const PathText& path_text_;
};

KeyWriter::Text KeyWriter::operator()(std::vector<PoseKey>* value) {
    std::string text;
    for (PoseKey& pose : *value) {
        text += "    { " + inside_text(keys_of(pose)) + " },\n";
    }
    return text.empty() ? Text() : "[\n" + text + "]";
}

} // namespace

void read_keys(TomlTable& table, const Keys& keys) {
    for (const Key& key : keys) {
        if (key.is_read) {
            std::visit(KeyReader(table, key.name), key.value);
        }
    }
}

std::optional<std::string> value_text(const Key& key, const PathText& path_text) {
    return key.is_written ? std::visit(KeyWriter(path_text), key.value) : std::nullopt;
}

void write_keys(TomlWriter& out, const Keys& keys, const PathText& path_text) {
    for (const Key& key : keys) {
        if (const std::optional<std::string> text = value_text(key, path_text)) {
            out.write(key.name, *text, key.note.empty() ? key.unit : key.note);
        }
    }
}

} // namespace weft
