#include "base/error.h"
#include "scene/format_checks.h"
#include "scene/text_scan.h"

namespace weft {

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
