#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/file.h"

namespace sonarsim {

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
