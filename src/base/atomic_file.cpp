#include "base/atomic_file.h"

#include "base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace weft {

namespace {

class OpenFile {
public:
    explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
    ~OpenFile() { close(); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    int get() const { return descriptor_; }
    int close() {
        const int result = descriptor_ >= 0 ? ::close(descriptor_) : 0;
        descriptor_ = -1;
        return result;
    }

private:
    int descriptor_;
};

[[noreturn]] void
fail_write(const std::filesystem::path& path, const std::string& aside, int reason) {
    ::unlink(aside.c_str());
    fail_disk("{}: cannot write: {}", path.string(), std::strerror(reason));
}

} // namespace

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
    const std::string aside = path.string() + ".part";
    OpenFile file(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) {
        fail_write(path, aside, errno);
    }
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) {
            fail_write(path, aside, errno);
        }
        bytes.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
    }
    if (::fsync(file.get()) != 0 || file.close() != 0 ||
        ::rename(aside.c_str(), path.c_str()) != 0) {
        fail_write(path, aside, errno);
    }
}

void write_atomically(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    write_atomically(path,
                     std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

std::string read_file(const std::filesystem::path& path) {
    std::error_code ignored; // what cannot be asked cannot be opened either
    if (std::filesystem::is_directory(path, ignored)) {
        fail_disk("{}: cannot read: is a folder", path.string());
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        fail_disk("{}: cannot read: {}", path.string(), std::strerror(errno));
    }
    std::ostringstream text;
    text << file.rdbuf();
    if (file.bad()) {
        fail_disk("{}: cannot read: {}", path.string(), std::strerror(errno));
    }
    return std::move(text).str();
}

} // namespace weft
