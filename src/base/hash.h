#pragma once

#include <cstdint>
#include <span>

namespace weft {

/// FNV-1a over bytes, 64 bit: tells whether two states are the same bits. Not for security.
class Hash {
public:
    template <typename T> void add(std::span<const T> values) {
        add_bytes(reinterpret_cast<const unsigned char*>(values.data()), values.size_bytes());
    }
    void add_bytes(const unsigned char* bytes, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            value_ = (value_ ^ bytes[i]) * 0x100000001b3ULL;
        }
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

} // namespace weft
