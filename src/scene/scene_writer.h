#pragma once

#include "base/eigen.h"
#include "scene/params.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// The scene as TOML with every value filled in and fabrics written out, so that reading it from a
/// file in `folder` gives the same scene: paths of meshes are rewritten relative to `folder`, all
/// numbers are in the shortest form that reads back to the same bits.
std::string write_scene(const Scene& scene, const std::filesystem::path& folder);

/// Writes TOML line by line: `key = value  # comment`. Numbers take the shortest form that reads
/// back to the same bits.
class TomlWriter {
public:
    /// `[name]` or `[[name]]`, after a blank line.
    void header(std::string_view bracketed);
    template <typename T>
    void line(std::string_view key, const T& value, std::string_view comment = "") {
        write(key, toml_text(value), comment);
    }
    /// The value is TOML already.
    void write(std::string_view key, std::string_view value, std::string_view comment = "");

    static std::string toml_text(bool value);
    static std::string toml_text(int value);
    static std::string toml_text(double value);
    static std::string toml_text(const std::string& value);
    static std::string toml_text(const char* value) { return toml_text(std::string(value)); }
    static std::string toml_text(const Vec2& value) { return vector_text(value); }
    static std::string toml_text(const Vec3& value) { return vector_text(value); }
    template <typename T, std::size_t N>
    static std::string toml_text(const std::array<T, N>& value) {
        return list_text(value);
    }
    template <typename T> static std::string toml_text(const std::vector<T>& value) {
        return list_text(value);
    }

    const std::string& text() const { return text_; }

private:
    template <typename V> static std::string vector_text(const V& value) {
        return list_text(std::vector<double>(value.data(), value.data() + value.size()));
    }
    template <typename L> static std::string list_text(const L& list) {
        std::string text = "[";
        for (const auto& element : list) {
            text += (text.size() > 1 ? ", " : "") + toml_text(element);
        }
        return text + "]";
    }

    std::string text_;
};

} // namespace weft
