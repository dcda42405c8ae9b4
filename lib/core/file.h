#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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

/// The bytes of a user's file. InputError unless it can be read, is regular and within `limit`.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// Writes to a temporary name next to `path` and renames it: a reader sees the old file or the
/// whole new one, and a link at `path` is replaced, not followed. std::system_error when the disk
/// refuses; no temporary file is left then.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// As write_file(); when it returns, the file survives a power cut.
void write_file_durably(const std::filesystem::path& path, std::string_view bytes);

/// Makes all that was written to the file system of `folder` durable. One call for a thousand files
/// costs a fraction of a thousand fsync() calls. std::system_error when the disk refuses.
void sync_file_system(const std::filesystem::path& folder);

/// Throws std::system_error for errno with the text "`what` `path`: No space left on device".
[[noreturn]] void throw_errno(const char* what, const std::filesystem::path& path);

/// A new temporary name, ".<name>.<16 random hex digits>.part". A hidden sibling of `path`: a
/// rename stays in one file system. Random: processes in two containers may have one id.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// True if temporary_name() made this name.
bool is_temporary_name(std::string_view name);

/// A file that has a temporary name while it is written: a reader sees the old file or the whole
/// new one. The destructor removes a file that was not committed.
class AtomicFile {
  public:
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::filesystem::path& part() const { return part_; }
    /// Renames the file to its final name. std::system_error when the disk refuses.
    void commit();

  private:
    std::filesystem::path path_;
    std::filesystem::path part_;
    bool committed_ = false;
};

/// The bytes of a durable file survive a power cut.
enum class Durable { no, yes };

/// A file of any length that is written in pieces. std::system_error when the disk refuses.
class StreamedFile {
  public:
    explicit StreamedFile(const std::filesystem::path& path);
    void append(std::string_view bytes);
    void finish(Durable durable = Durable::no);

  private:
    void put(std::string_view bytes);

    AtomicFile atomic_file_;
    Descriptor file_;
    std::string pending_;  ///< buffer, since lines are appended by the thousand
};

// The next three are for folders that anybody may have filled: what a link names may be private.

/// InputError when the path is a symbolic link. `what` is what a user writes there: "a dataset".
void require_no_link(const std::filesystem::path& path, const std::string& what);

/// Up to `size` bytes of a file from `offset` on. InputError unless it is regular and readable.
std::string read_bytes(const std::filesystem::path& path, std::size_t offset, std::size_t size);

/// Copies a file: a reader sees the old file or the whole new one; a link is replaced. InputError
/// as read_bytes() for `from`; std::system_error, which names `to`, when the disk refuses.
void copy_regular_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// An empty folder for temporary files, which goes with this object. std::system_error by the disk.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace sonarsim
