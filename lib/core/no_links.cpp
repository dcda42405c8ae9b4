#include "core/no_links.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/error.h"
#include "core/file.h"

namespace sonarsim {

namespace {

/// A regular file that is open for reading.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path)
        : path_(path), fd_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC)) {
        struct stat status {};
        if (fd_ < 0 || ::fstat(fd_, &status) != 0) refuse();
        size_ = static_cast<std::size_t>(status.st_size);
        if (S_ISREG(status.st_mode)) return;
        ::close(fd_);
        throw InputError({path_.string()}, "is not a regular file");
    }
    ~RegularFile() { ::close(fd_); }
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    std::size_t size() const { return size_; }

    /// Fewer than `size` bytes where the file ends.
    std::string read(std::size_t offset, std::size_t size) const {
        std::string bytes(std::min(size, size_ - std::min(offset, size_)), '\0');
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t got = ::pread(fd_, bytes.data() + done, bytes.size() - done,
                                        static_cast<off_t>(offset + done));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) refuse();
            if (got == 0) break;
            done += static_cast<std::size_t>(got);
        }
        bytes.resize(done);
        return bytes;
    }

  private:
    [[noreturn]] void refuse() const {
        throw InputError({path_.string()},
                         errno == ELOOP
                             ? "is a symbolic link; put the file itself in its place"
                             : "cannot be read: " + std::generic_category().message(errno));
    }

    const std::filesystem::path& path_;
    int fd_;
    std::size_t size_ = 0;
};

}  // namespace

void require_no_link(const std::filesystem::path& path, const std::string& what) {
    if (!std::filesystem::is_symlink(path)) return;
    throw InputError({path.string()}, "is a symbolic link, and " + what +
                                          " is written into folders of its own; remove the link "
                                          "or choose another output folder");
}

std::string read_bytes(const std::filesystem::path& path, std::size_t offset, std::size_t size) {
    return RegularFile(path).read(offset, size);
}

void copy_regular_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    constexpr std::size_t piece = std::size_t{1} << 20;
    const RegularFile source(from);
    StreamedFile target(to);
    for (std::size_t at = 0; at < source.size(); at += piece)
        target.append(source.read(at, piece));
    target.finish();
}

}  // namespace sonarsim
