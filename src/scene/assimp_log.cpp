#include "scene/assimp_log.h"

#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>

namespace weft {

namespace {

class Collector : public Assimp::LogStream {
public:
    explicit Collector(std::vector<std::string>& lines) : lines_(lines) {}

    /// Lines look like "Warn,  T0: words\n".
    void write(const char* message) override {
        std::string line = message;
        const std::size_t start = line.find(": ");
        line = line.substr(start == std::string::npos ? 0 : start + 2);
        lines_.push_back(line.substr(0, line.find('\n')));
    }

private:
    std::vector<std::string>& lines_;
};

} // namespace

AssimpLog::AssimpLog() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Collector(lines_), // the logger deletes it
                                               Assimp::Logger::Warn | Assimp::Logger::Err);
}

AssimpLog::~AssimpLog() {
    Assimp::DefaultLogger::kill();
}

std::string AssimpLog::find(const std::string& words) const {
    for (const std::string& line : lines_) {
        if (line.find(words) != std::string::npos) {
            return line;
        }
    }
    return "";
}

} // namespace weft
