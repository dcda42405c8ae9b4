#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

/// The values of a file in C order, the last index first.
struct RecordedArray {
    std::vector<std::size_t> shape;
    std::vector<double> values;
};

/// The most values of one file, and of all pings of a recording.
inline constexpr std::size_t most_recorded_values = std::size_t{1} << 28;

/// The array in the bytes of a .npy file, or of a grey PNG file of 8 or 16 bits. `name` is the
/// file's name, for the messages; the bytes say the format. InputError when it is neither, is
/// damaged, or holds more than most_recorded_values.
RecordedArray read_array(std::string_view bytes, const std::string& name);

/// The same of a file. InputError when it cannot be read.
RecordedArray read_array_file(const std::filesystem::path& path);

}  // namespace sonarsim
