#include "output/dataset/record_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "core/hash.h"

namespace sonarsim {

namespace {

/// Writes or reads all of `size` bytes at `offset`; pread() and pwrite() may do it in parts.
template <class Transfer, class Byte>
bool transfer_all(Transfer transfer, int fd, Byte* bytes, std::size_t size, std::uint64_t offset) {
    const auto moved = move_all(size, [&](std::size_t done) {
        return transfer(fd, bytes + done, size - done, static_cast<off_t>(offset + done));
    });
    if (moved && *moved < size) errno = EIO;
    return moved == size;
}

Descriptor open_file(const std::filesystem::path& path, RecordAccess access) {
    const bool writes = access == RecordAccess::write;
    if (writes) std::filesystem::create_directories(path.parent_path());
    return {path, (writes ? O_RDWR | O_CREAT : O_RDONLY) | O_NOFOLLOW};
}

}  // namespace

std::string hash_of_record(std::string_view bytes) {
    return fnv1a_128(bytes).substr(0, 16);
}

RecordFile::RecordFile(const std::filesystem::path& path, const NpyFormat& format,
                       std::size_t records, RecordAccess access)
    : path_(path),
      records_(records),
      record_bytes_(format.type.back() - '0'),
      access_(access),
      file_(open_file(path, access)) {
    if (file_.get() < 0) throw_errno("cannot open", path);
    for (const std::size_t length : format.shape)
        record_bytes_ *= length;
    record_bytes_ /= std::max<std::size_t>(records, 1);
    const std::string header = npy_header(format);
    header_bytes_ = header.size();
    prepare(header);
}

/// Makes the open file one of this format and length.
void RecordFile::prepare(const std::string& header) const {
    // No temporary name and no truncation: two shards may begin at once and make the same file.
    struct stat status {};
    std::string found(header.size(), '\0');
    const bool whole = ::fstat(file_.get(), &status) == 0 &&
                       static_cast<std::uint64_t>(status.st_size) == offset(records_) &&
                       transfer_all(::pread, file_.get(), found.data(), found.size(), 0) &&
                       found == header;
    if (whole) return;
    if (access_ == RecordAccess::read)
        throw std::runtime_error(path_.string() + " has not the format and length that it should");
    const bool ready = transfer_all(::pwrite, file_.get(), header.data(), header.size(), 0) &&
                       ::ftruncate(file_.get(), static_cast<off_t>(offset(records_))) == 0;
    if (!ready) throw_errno("cannot write", path_);
}

void RecordFile::close() {
    if (!file_.close()) throw_errno("cannot write", path_);
}

void RecordFile::write(std::size_t record, std::span<const std::byte> bytes) const {
    if (record >= records_ || bytes.size() != record_bytes_)
        throw std::logic_error("a record does not fit " + path_.string());
    if (!transfer_all(::pwrite, file_.get(), bytes.data(), bytes.size(), offset(record)))
        throw_errno("cannot write", path_);
}

void RecordFile::read(std::size_t record, std::span<std::byte> bytes) const {
    if (!transfer_all(::pread, file_.get(), bytes.data(), bytes.size(), offset(record)))
        throw_errno("cannot read", path_);
}

std::string RecordFile::hash(std::size_t record) const {
    std::string bytes(record_bytes_, '\0');
    read(record, std::as_writable_bytes(std::span(bytes)));
    return hash_of_record(bytes);
}

}  // namespace sonarsim
