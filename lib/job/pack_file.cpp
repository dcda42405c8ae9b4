#include "job/pack_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/file.h"

namespace sonarsim {

PackFile::PackFile(const std::filesystem::path& path)
    : path_(path), fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)) {
    if (fd_ < 0) throw_errno("cannot write", path_);
}

PackFile::~PackFile() {
    if (fd_ >= 0) ::close(fd_);
}

void PackFile::write(std::uint64_t offset, std::string_view bytes) {
    if (fd_ < 0) fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    if (fd_ < 0) throw_errno("cannot write", path_);
    while (!bytes.empty()) {
        const ssize_t put = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) throw_errno("cannot write", path_);
        offset += static_cast<std::uint64_t>(put);
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
}

void PackFile::pause() {
    if (::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

void PackFile::finish(std::uint64_t bytes) {
    const bool cut = ::ftruncate(fd_, static_cast<off_t>(bytes)) == 0;
    if (!cut || ::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

}  // namespace sonarsim
