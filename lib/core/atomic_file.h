#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sonarsim {

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

/// A file of any length that is written in pieces. std::system_error when the disk refuses.
class StreamedFile {
  public:
    explicit StreamedFile(const std::filesystem::path& path);
    void append(std::string_view bytes);
    void finish();

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void put(std::string_view bytes);

    AtomicFile atomic_file_;
    std::unique_ptr<std::FILE, Close> file_;
    std::string pending_;  ///< buffer, since lines are appended by the thousand
};

}  // namespace sonarsim
