#include "scene/format_checks.h"

#include "base/error.h"
#include "scene/text_scan.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace weft {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string
check_format(std::ifstream& stream, const std::string& extension, const std::string& name) {
    const bool is_checked = extension == ".obj" || extension == ".ply" || extension == ".stl" ||
                            extension == ".off" || extension == ".glb";
    if (!is_checked) {
        return "";
    }
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (extension == ".obj") {
        return check_obj(bytes, name);
    }
    if (extension == ".ply") {
        check_ply(bytes, name);
    } else if (extension == ".stl") {
        check_stl(bytes, name);
    } else if (extension == ".off") {
        check_off(bytes, name);
    } else {
        check_glb(bytes, name);
    }
    return "";
}

} // namespace

std::string check_mesh_file(const std::filesystem::path& file, const std::string& name) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        fail_input("{}: no such file", name);
    }
    if (std::filesystem::is_directory(status)) {
        fail_input("{}: is a folder, not a mesh file", name);
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        fail_input("{}: cannot be opened for reading", name);
    }
    if (stream.peek() == std::ifstream::traits_type::eof()) {
        fail_input("{}: is empty", name);
    }
    return check_format(stream, lower_extension(file), name);
}

namespace {

using Words = std::vector<std::string_view>;

/// v, vt and vn of an OBJ file: how many there are, and the greatest that a face names.
struct Kind {
    const char* meaning;
    long long count = 0;
    long long greatest = 0;
    std::size_t line_of_greatest = 0;
};

class ObjCheck {
public:
    ObjCheck(std::string_view text, const std::string& name)
        : text_(text), name_(name), lines_(text) {}

    std::string run() {
        std::string_view line;
        Words words;
        while (lines_.next(line)) {
            split_words(line, words);
            if (words.empty()) {
                continue;
            }
            if (words[0] == "v") {
                read_vertex(words);
            } else if (words[0] == "vt" || words[0] == "vn") {
                ++kinds_[words[0] == "vt" ? 1 : 2].count;
            } else if (words[0] == "f") {
                read_face(words);
            } else if (words[0] == "l" || words[0] == "p") {
                has_lines_or_points_ = true;
            }
        }
        check_ranges();
        return check_end();
    }

private:
    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        fail_input("{}:{}: {}", name_, lines_.number(),
                   fmt::format(format, std::forward<Args>(args)...));
    }

    void read_vertex(const Words& words) {
        ++kinds_[0].count;
        used_.push_back(0);
        if (words.size() < 4) {
            fail("vertex {} has {} coordinates of 3: damaged or truncated file", kinds_[0].count,
                 words.size() - 1);
        }
        for (std::size_t k = 1; k <= 3; ++k) {
            const auto value = to_number(words[k]);
            if (!value) {
                fail("vertex {}: \"{}\" is not a number", kinds_[0].count, words[k]);
            }
            if (!std::isfinite(*value) || std::abs(*value) > std::numeric_limits<float>::max()) {
                fail("vertex {}: \"{}\": a coordinate must be a finite number", kinds_[0].count,
                     words[k]);
            }
        }
    }

    void read_face(const Words& words) {
        ++faces_;
        if (words.size() < 4) {
            fail("face {} has {} corners: a face needs 3 (damaged or truncated file)", faces_,
                 words.size() - 1);
        }
        for (std::size_t k = 1; k < words.size(); ++k) {
            read_corner(words[k]);
        }
    }

    /// "7", "7/3", "7//2" or "7/3/2"; all corners of a face alike.
    void read_corner(std::string_view corner) {
        const std::string_view whole = corner;
        for (std::size_t kind = 0; kind < 3; ++kind) {
            const std::size_t slash = std::min(corner.find('/'), corner.size());
            const std::string_view part = corner.substr(0, slash);
            if (!part.empty()) {
                read_index(part, kind, whole);
            } else if (kind == 0) {
                fail("face {}: \"{}\" is not a corner (v, v/vt, v//vn or v/vt/vn)", faces_, whole);
            }
            if (slash == corner.size()) {
                return;
            }
            corner.remove_prefix(slash + 1);
        }
    }

    void read_index(std::string_view part, std::size_t kind, std::string_view corner) {
        const auto index = to_integer(part);
        Kind& k = kinds_[kind];
        if (!index) {
            fail("face {}: \"{}\" is not a corner (v, v/vt, v//vn or v/vt/vn)", faces_, corner);
        }
        const long long absolute = *index < 0 ? k.count + 1 + *index : *index;
        if (absolute < 1) {
            fail("face {} names {} {}: allowed are 1 to {}, or -1 to -{}", faces_, k.meaning,
                 *index, k.count, k.count);
        }
        if (absolute > k.greatest) {
            k.greatest = absolute;
            k.line_of_greatest = lines_.number();
        }
        if (kind == 0 && static_cast<std::size_t>(absolute) <= used_.size()) {
            used_[static_cast<std::size_t>(absolute) - 1] = 1;
        }
    }

    void check_ranges() const {
        for (const Kind& k : kinds_) {
            if (k.greatest > k.count) {
                fail_input("{}:{}: a face names {} {}, but the file has {}", name_,
                           k.line_of_greatest, k.meaning, k.greatest, k.count);
            }
        }
    }

    /// An OBJ file does not say how much should follow. One that stops inside a line and leaves
    /// vertices without a face was cut.
    std::string check_end() const {
        std::size_t unused = 0;
        for (const char used : used_) {
            unused += used ? 0 : 1;
        }
        if (unused == 0 || faces_ == 0 || has_lines_or_points_) {
            return "";
        }
        if (text_.back() != '\n' && text_.back() != '\r') {
            fail_input("{}:{}: truncated: the file ends inside a line, and {} of its {} vertices "
                       "are in no face",
                       name_, lines_.number(), unused, kinds_[0].count);
        }
        return fmt::format("{} of {} vertices in the file are in no face and were left out", unused,
                           kinds_[0].count);
    }

    std::string_view text_;
    const std::string& name_;
    LineScanner lines_;
    std::array<Kind, 3> kinds_{{{"vertex"}, {"uv"}, {"normal"}}};
    std::vector<char> used_; ///< by vertex, from 0
    long long faces_ = 0;
    bool has_lines_or_points_ = false;
};

} // namespace

std::string check_obj(std::string_view bytes, const std::string& name) {
    if (bytes.find('\0') != std::string_view::npos) {
        fail_input("{}: is not an OBJ text in ASCII or UTF-8 (it has zero bytes)", name);
    }
    const bool has_continued_lines = bytes.find("\\\n") != std::string_view::npos ||
                                     bytes.find("\\\r") != std::string_view::npos;
    return has_continued_lines ? "" : ObjCheck(bytes, name).run(); // rare; left to assimp
}

namespace {

/// Lines with words on them; comments and empty ones are skipped.
class WordLines {
public:
    WordLines(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

    bool next(std::vector<std::string_view>& words) {
        std::string_view line;
        while (lines_.next(line)) {
            split_words(line, words);
            if (!words.empty()) {
                return true;
            }
        }
        return false;
    }

    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        fail_input("{}:{}: {}", name_, lines_.number(),
                   fmt::format(format, std::forward<Args>(args)...));
    }

private:
    LineScanner lines_;
    const std::string& name_;
};

struct Counts {
    long long vertices, faces;
};

Counts read_counts(WordLines& lines, std::vector<std::string_view>& words) {
    const bool has_header = lines.next(words) && words[0].find("OFF") != std::string_view::npos;
    if (!has_header) {
        lines.fail("does not begin with OFF");
    }
    words.erase(words.begin());
    if (words.empty() && !lines.next(words)) {
        lines.fail("truncated: the counts of vertices and faces are missing");
    }
    const auto vertices = to_integer(words[0]);
    const auto faces = words.size() > 1 ? to_integer(words[1]) : std::nullopt;
    if (!vertices || !faces || *vertices < 0 || *faces < 0) {
        lines.fail("the counts of vertices and faces must be two whole numbers");
    }
    return {*vertices, *faces};
}

void check_face(const WordLines& lines,
                const std::vector<std::string_view>& words,
                long long face,
                long long vertices) {
    const auto corners = to_integer(words[0]);
    if (!corners || *corners < 1 || words.size() < static_cast<std::size_t>(*corners) + 1) {
        lines.fail("face {} does not have the corners that it announces: damaged or truncated file",
                   face);
    }
    for (std::size_t k = 1; k <= static_cast<std::size_t>(*corners); ++k) {
        const auto index = to_integer(words[k]);
        if (!index || *index < 0 || *index >= vertices) {
            lines.fail("face {} names vertex {}: allowed are 0 to {}", face, words[k],
                       vertices - 1);
        }
    }
}

} // namespace

void check_off(std::string_view bytes, const std::string& name) {
    WordLines lines(bytes, name);
    std::vector<std::string_view> words;
    const Counts counts = read_counts(lines, words);
    for (long long v = 0; v < counts.vertices; ++v) {
        if (!lines.next(words)) {
            lines.fail("truncated: {} vertices announced, {} found", counts.vertices, v);
        }
        if (words.size() < 3 || !to_number(words[0]) || !to_number(words[1]) ||
            !to_number(words[2])) {
            lines.fail("vertex {} does not have three coordinates: damaged or truncated file", v);
        }
    }
    for (long long f = 0; f < counts.faces; ++f) {
        if (!lines.next(words)) {
            lines.fail("truncated: {} faces announced, {} found", counts.faces, f);
        }
        check_face(lines, words, f, counts.vertices);
    }
}

} // namespace weft
