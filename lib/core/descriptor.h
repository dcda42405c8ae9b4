#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

namespace sonarsim {

/// An open file. -1 where it could not be opened; errno says why.
class Descriptor {
  public:
    Descriptor(const std::filesystem::path& path, int flags)
        : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int get() const { return fd_; }
    /// Returns the result of close(): some file systems report a full disk only here.
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

/// Reads or writes `size` bytes in as many parts as the system makes of them: move(done) moves some
/// of the bytes from `done` on. Returns their number, which is less at the end of a file; nothing,
/// with the reason in errno, where the disk refuses.
std::optional<std::size_t> move_all(std::size_t size, const auto& move) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t moved = move(done);
        if (moved < 0 && errno == EINTR) continue;
        if (moved < 0) return std::nullopt;
        if (moved == 0) break;
        done += static_cast<std::size_t>(moved);
    }
    return done;
}

}  // namespace sonarsim
