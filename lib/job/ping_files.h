#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/layout.h"
#include "job/resume.h"

namespace sonarsim {

/// The output of each writer of a sensor for a ping, in their order: the bytes of a file or record.
using EncodedPing = std::vector<std::string>;

/// A ping for the journal. The references must outlive it.
struct PingToList {
    const SensorLayout& sensor;
    const EncodedPing& encoded;
};
/// The fields of each ping in the journal. The sums of several pings' files take less time
/// together.
std::vector<std::vector<std::string>> journal_fields(std::span<const PingToList> pings);

/// Reads a ping that is in a dataset. `finished` is that of the dataset. InputError when a file
/// cannot be read; std::system_error when the disk fails.
EncodedPing read_ping(const Layout& layout, const RecordFiles& records,
                      const FinishedPings& finished, const PingId& ping);

/// A pack that is being filled under its final name, as records are. Two runs may write it at the
/// same time: they write the same bytes.
class PackFile {
  public:
    /// Makes the file where there is none. std::system_error when the disk does not allow it, or
    /// when the name belongs to a symbolic link.
    explicit PackFile(const std::filesystem::path& path);
    ~PackFile();
    PackFile(const PackFile&) = delete;
    PackFile& operator=(const PackFile&) = delete;

    /// std::system_error when the disk does not take it, or when the file was removed since.
    void write(std::uint64_t offset, std::string_view bytes);
    /// Closes the file until the next write(). std::system_error when the disk did not take all.
    void pause();
    /// Cuts off what an interrupted run left beyond `bytes`, and closes the file. std::system_error
    /// when the disk did not take all of it.
    void finish(std::uint64_t bytes);

  private:
    std::filesystem::path path_;
    int fd_;
};

/// Writes pings where the layout says. The references must outlive it.
class PingFiles {
  public:
    /// `there`: the pings that the dataset held when the run began.
    PingFiles(const Layout& layout, const RecordFiles& records, const FinishedPings& there);

    /// Writes loose files and records. From any thread, in any order.
    /// std::system_error when the disk does not take it.
    void write(const PingId& ping, const EncodedPing& encoded) const;
    /// Adds to packs: from one thread at a time, and for each sensor in the order of its pings.
    /// std::system_error as above.
    void pack(const PingId& ping, const EncodedPing& encoded);

  private:
    /// The pack of a sensor that is being filled.
    struct Filling {
        std::size_t number = 0;
        std::uint64_t end = 0;  ///< bytes of the pings in it
        std::unique_ptr<PackFile> file;
    };

    const Layout& layout_;
    const RecordFiles& records_;
    const FinishedPings& there_;
    std::vector<Filling> filling_;  ///< one for each sensor
    bool keep_open_;                ///< true if packs stay open between two pings
};

}  // namespace sonarsim
