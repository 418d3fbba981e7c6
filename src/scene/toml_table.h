#pragma once

#include "base/eigen.h"

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft {

/// A table being read: typed access by key, every refusal in one line `place: path = value: what is
/// allowed` (Error, BadInput), and a record of the keys that were asked for, so that finish() can
/// refuse the others.
///
/// read() leaves `value` as it is when the key is missing, and returns whether it was there.
/// Numbers must be finite; an integer may stand for a number, not the other way round.
class TomlTable {
public:
    /// @param path   of the table in messages, e.g. `cloth[0].fabric`; empty for the root
    TomlTable(const toml::table& table, std::string path);

    bool has(std::string_view key);
    bool is_string(std::string_view key);
    bool is_table(std::string_view key);
    bool is_array(std::string_view key);

    bool read(std::string_view key, bool& value);
    bool read(std::string_view key, int& value);
    bool read(std::string_view key, double& value);
    bool read(std::string_view key, std::string& value);
    bool read(std::string_view key, Vec2& value);
    bool read(std::string_view key, Vec3& value);
    bool read(std::string_view key, std::array<int, 2>& value);
    bool read(std::string_view key, std::vector<int>& value);
    bool read(std::string_view key, std::vector<std::array<double, 4>>& value);
    /// A string, or an array of strings.
    bool read(std::string_view key, std::vector<std::string>& value);

    /// The index of the word under a key among `words`; -1 when the key is missing.
    int read_word(std::string_view key, const std::vector<std::string>& words);

    /// The table under a key; it must be there and be a table.
    TomlTable table(std::string_view key);
    /// The tables under a key: of `[[key]]` or an array of inline tables; none when it is missing.
    std::vector<TomlTable> tables(std::string_view key);

    /// Refuses with a finding of problem(): "KEY = VALUE: what is allowed"; "" is fine. The place
    /// is the key's, or the table's when the value is a default.
    void refuse(const std::string& problem) const;
    /// Refuses the value under a key: `place: path.key = value: what`.
    [[noreturn]] void fail(std::string_view key, std::string_view what) const;
    /// Refuses the table itself: `place: path: what`.
    [[noreturn]] void fail(std::string_view what) const;
    /// Refuses the first key that nothing asked for, naming the nearest that something did.
    void finish() const;

    const std::string& path() const { return path_; }
    std::string path_to(std::string_view key) const;

private:
    const toml::node* find(std::string_view key);
    template <typename V> bool read_vector(std::string_view key, V& value, std::size_t size);

    const toml::table* table_;
    std::string path_;
    std::vector<std::string> known_;
};

} // namespace weft
