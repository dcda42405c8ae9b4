#include "core/no_links.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/descriptor.h"
#include "core/error.h"
#include "core/file.h"

namespace sonarsim {

namespace {

/// A regular file that is open for reading.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path)
        : path_(path), file_(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW) {
        struct stat status {};
        if (file_.get() < 0 || ::fstat(file_.get(), &status) != 0) refuse();
        size_ = static_cast<std::size_t>(status.st_size);
        if (!S_ISREG(status.st_mode)) throw InputError({path_.string()}, "is not a regular file");
    }

    std::size_t size() const { return size_; }

    /// Fewer than `size` bytes where the file ends.
    std::string read(std::size_t offset, std::size_t size) const {
        std::string bytes(std::min(size, size_ - std::min(offset, size_)), '\0');
        const auto got = move_all(bytes.size(), [&](std::size_t done) {
            return ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                           static_cast<off_t>(offset + done));
        });
        if (!got) refuse();
        bytes.resize(*got);
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
    Descriptor file_;
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
