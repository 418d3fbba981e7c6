#pragma once

#include <string>
#include <vector>

namespace weft {

/// Collects what assimp warns of while it lives; assimp has one log for the process, so there may
/// be one of these at a time.
class AssimpLog {
public:
    AssimpLog();
    ~AssimpLog();
    AssimpLog(const AssimpLog&) = delete;
    AssimpLog& operator=(const AssimpLog&) = delete;

    /// The first warning that contains `words`, without its line end; "" when there is none.
    std::string find(const std::string& words) const;

private:
    std::vector<std::string> lines_;
};

} // namespace weft
