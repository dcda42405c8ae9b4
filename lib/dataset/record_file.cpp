#include "dataset/record_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "core/file.h"
#include "core/hash.h"

namespace sonarsim {

namespace {

/// Writes or reads all of `size` bytes at `offset`; pread() and pwrite() may do it in parts.
template <class Transfer, class Byte>
bool transfer_all(Transfer transfer, int fd, Byte* bytes, std::size_t size, std::uint64_t offset) {
    while (size > 0) {
        const ssize_t done = transfer(fd, bytes, size, static_cast<off_t>(offset));
        if (done < 0 && errno == EINTR) continue;
        if (done == 0) errno = EIO;
        if (done <= 0) return false;
        bytes += done;
        size -= static_cast<std::size_t>(done);
        offset += static_cast<std::uint64_t>(done);
    }
    return true;
}

}  // namespace

std::string hash_of_record(std::string_view bytes) {
    return fnv1a_128(bytes).substr(0, 16);
}

RecordFile::RecordFile(const std::filesystem::path& path, const NpyFormat& format,
                       std::size_t records, RecordAccess access)
    : path_(path), records_(records), record_bytes_(format.type.back() - '0') {
    for (const std::size_t length : format.shape)
        record_bytes_ *= length;
    record_bytes_ /= std::max<std::size_t>(records, 1);
    const std::string header = npy_header(format);
    header_bytes_ = header.size();
    const bool writes = access == RecordAccess::write;
    if (writes) std::filesystem::create_directories(path.parent_path());
    fd_ =
        ::open(path.c_str(), (writes ? O_RDWR | O_CREAT : O_RDONLY) | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd_ < 0) throw_errno("cannot open", path);
    // No temporary name and no truncation: two shards that begin at once make the same file, and
    // neither can take away what the other has written into it.
    struct stat status {};
    std::string found(header.size(), '\0');
    const bool whole = ::fstat(fd_, &status) == 0 &&
                       static_cast<std::uint64_t>(status.st_size) == offset(records) &&
                       transfer_all(::pread, fd_, found.data(), found.size(), 0) && found == header;
    if (!whole && !writes) {
        ::close(fd_);
        throw std::runtime_error(path.string() + " has not the format and length that it should");
    }
    const bool ready = whole || (transfer_all(::pwrite, fd_, header.data(), header.size(), 0) &&
                                 ::ftruncate(fd_, static_cast<off_t>(offset(records))) == 0);
    if (ready) return;
    const int reason = errno;
    ::close(fd_);
    errno = reason;
    throw_errno("cannot write", path);
}

RecordFile::~RecordFile() {
    if (fd_ >= 0) ::close(fd_);
}

void RecordFile::require_in_place() const {
    struct stat opened {};
    struct stat named {};
    if (::fstat(fd_, &opened) != 0) throw_errno("cannot read", path_);
    if (::lstat(path_.c_str(), &named) == 0 && named.st_dev == opened.st_dev &&
        named.st_ino == opened.st_ino)
        return;
    throw std::runtime_error(path_.string() +
                             " was removed or replaced during the run; the same command run again "
                             "renders what is missing");
}

void RecordFile::close() {
    if (::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

void RecordFile::write(std::size_t record, std::span<const std::byte> bytes) const {
    if (record >= records_ || bytes.size() != record_bytes_) {
        throw std::logic_error("a record does not fit " + path_.string());
    }
    if (!transfer_all(::pwrite, fd_, bytes.data(), bytes.size(), offset(record))) {
        throw_errno("cannot write", path_);
    }
}

void RecordFile::read(std::size_t record, std::span<std::byte> bytes) const {
    if (!transfer_all(::pread, fd_, bytes.data(), bytes.size(), offset(record))) {
        throw_errno("cannot read", path_);
    }
}

std::string RecordFile::hash(std::size_t record) const {
    std::string bytes(record_bytes_, '\0');
    read(record, std::as_writable_bytes(std::span(bytes)));
    return hash_of_record(bytes);
}

}  // namespace sonarsim
