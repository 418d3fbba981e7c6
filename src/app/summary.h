#pragma once

#include "scene/params.h"
#include "state/world.h"

#include <fmt/core.h>

#include <string>

namespace weft {

/// Lines of "label  text" for a person, the texts under one another.
class SummaryLines {
public:
    /// Adds a line; an empty label continues the one above.
    template <typename... Args>
    void row(const char* label, fmt::format_string<Args...> format, Args&&... args) {
        text +=
            fmt::format("  {:<14}{}\n", label, fmt::format(format, std::forward<Args>(args)...));
    }

    std::string text;
};

/// "1 part", "3 parts".
inline std::string plural(std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// What a run would compute, a line an object and a line for the whole, for people.
std::string summarise(const Scene& scene, const World& world);

} // namespace weft
