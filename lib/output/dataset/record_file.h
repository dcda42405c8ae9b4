#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "output/format/npy.h"

namespace sonarsim {

/// The values of a record as its bytes.
template <class T>
std::string record_bytes(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// 16 hexadecimal digits for a record in the journal.
std::string hash_of_record(std::string_view bytes);

enum class RecordAccess {
    write,  ///< opens the file, or makes it and the folders above
    read,   ///< opens a file that is there
};

/// A NumPy file of equal records, one per ping, that any thread and process fills in any order. It
/// has its full length from the beginning: missing records are zero and take no space on the disk.
class RecordFile {
  public:
    /// The data of `format` are `records` records. std::system_error when the disk does not allow
    /// it or for a link; std::runtime_error if a file to read is not of this format and length.
    RecordFile(const std::filesystem::path& path, const NpyFormat& format, std::size_t records,
               RecordAccess access = RecordAccess::write);

    std::size_t records() const { return records_; }
    std::size_t record_bytes() const { return record_bytes_; }

    /// std::system_error when the disk does not take it.
    void write(std::size_t record, std::span<const std::byte> bytes) const;
    /// Fills `bytes` from the beginning of the record on; they may extend over the next records.
    void read(std::size_t record, std::span<std::byte> bytes) const;
    /// The hash of a record's bytes, as hash_of_record().
    std::string hash(std::size_t record) const;

    /// std::system_error when the disk did not take all records, which some report only here.
    void close();

  private:
    std::uint64_t offset(std::size_t record) const {
        return header_bytes_ + record * record_bytes_;
    }
    void prepare(const std::string& header) const;

    std::filesystem::path path_;
    std::size_t records_;
    std::size_t record_bytes_;
    std::size_t header_bytes_;
    RecordAccess access_;
    Descriptor file_;
};

}  // namespace sonarsim
