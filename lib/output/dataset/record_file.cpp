#include "output/dataset/record_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
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
    : path_(path), records_(records), record_bytes_(format.type.back() - '0'), access_(access) {
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
    try {
        prepare(header);
    } catch (...) {
        ::close(fd_);
        throw;
    }
}

/// Makes the open file one of this format and length.
void RecordFile::prepare(const std::string& header) const {
    // No temporary name and no truncation: two shards that begin at once make the same file, and
    // neither can remove what the other has written.
    struct stat status {};
    std::string found(header.size(), '\0');
    const bool whole = ::fstat(fd_, &status) == 0 &&
                       static_cast<std::uint64_t>(status.st_size) == offset(records_) &&
                       transfer_all(::pread, fd_, found.data(), found.size(), 0) && found == header;
    if (whole) return;
    if (access_ == RecordAccess::read)
        throw std::runtime_error(path_.string() + " has not the format and length that it should");
    const bool ready = transfer_all(::pwrite, fd_, header.data(), header.size(), 0) &&
                       ::ftruncate(fd_, static_cast<off_t>(offset(records_))) == 0;
    if (!ready) throw_errno("cannot write", path_);
}

RecordFile::~RecordFile() {
    if (fd_ >= 0) ::close(fd_);
}

void RecordFile::close() {
    if (fd_ >= 0 && ::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

void RecordFile::write(std::size_t record, std::span<const std::byte> bytes) const {
    if (record >= records_ || bytes.size() != record_bytes_) {
        throw std::logic_error("a record does not fit " + path_.string());
    }
    if (!transfer_all(::pwrite, fd_, bytes.data(), bytes.size(), offset(record)))
        throw_errno("cannot write", path_);
}

void RecordFile::read(std::size_t record, std::span<std::byte> bytes) const {
    if (!transfer_all(::pread, fd_, bytes.data(), bytes.size(), offset(record)))
        throw_errno("cannot read", path_);
}

std::string RecordFile::hash(std::size_t record) const {
    std::string bytes(record_bytes_, '\0');
    read(record, std::as_writable_bytes(std::span(bytes)));
    return hash_of_record(bytes);
}

}  // namespace sonarsim
