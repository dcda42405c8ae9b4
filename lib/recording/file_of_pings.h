#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "format/logged_soundings.h"
#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

// The parts that the readers of sonars' files share.

inline constexpr std::size_t largest_file_of_pings = std::size_t{1} << 31;

/// The result of `read` for the bytes of a file. InputError with its name if `read` finds it
/// damaged.
template <class Read>
auto parsed_file(const std::filesystem::path& path, const Read& read) {
    const std::string bytes = read_file(path, largest_file_of_pings);
    try {
        return read(bytes);
    } catch (const std::runtime_error& fault) {
        throw InputError({path.string()}, fault.what());
    }
}

/// Adds to the number of values of a recording. InputError if they become too many.
void count_values(std::size_t more, const std::filesystem::path& path, std::size_t& values);

/// Adds the soundings of a file to a recording. InputError if neither the file nor recording.yaml
/// has the speed of sound.
void add_soundings(const std::vector<LoggedSoundings>& pings, const std::filesystem::path& path,
                   const RecordingFile& file, std::size_t& values, Recording& recording);

}  // namespace sonarsim
