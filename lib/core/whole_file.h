#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sonarsim {

/// A name that a file bears while it is being written, beside the one that it gets in the end: a
/// reader sees the old file or the whole new one. What is not kept is removed.
class WholeFile {
  public:
    explicit WholeFile(const std::filesystem::path& path);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    const std::filesystem::path& part() const { return part_; }
    /// Gives the file its name. std::system_error when the disk refuses.
    void keep();

  private:
    std::filesystem::path path_;
    std::filesystem::path part_;
    bool kept_ = false;
};

/// A file of any length that is written piece by piece. std::system_error when the disk does not
/// take it.
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

    WholeFile whole_;
    std::unique_ptr<std::FILE, Close> file_;
    std::string pending_;  ///< lines come in by the thousand
};

}  // namespace sonarsim
