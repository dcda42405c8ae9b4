#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace sonarsim {

/// A pack that is being filled under its final name, as records are. Two runs may be at it: what
/// they write is the same.
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

}  // namespace sonarsim
