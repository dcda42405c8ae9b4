#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sonarsim {

// Archives in the format ustar (POSIX.1-1988), which all tar programs open. Their bytes depend on
// the names and bytes of their files alone: time and owner are 0, the mode is 0644.

/// Bytes at the end of an archive.
inline constexpr std::uint64_t tar_end_bytes = 1024;

/// The size of a file in an archive. One that no archive can hold counts as 8 GiB, so that sums of
/// sizes do not wrap.
std::uint64_t tar_bytes(std::uint64_t file_bytes);

/// Adds a file to an archive in memory. Throws std::logic_error when the name has more than 100
/// bytes or the file more than 8 GiB, the limits of the format.
void append_to_tar(std::string& archive, std::string_view name, std::string_view bytes);

/// Reads an archive that append_to_tar() made, file by file. Throws std::runtime_error when it is
/// no such archive or is cut off, std::system_error when the disk fails.
void for_each_in_tar(
    const std::filesystem::path& path,
    const std::function<void(const std::string& name, const std::string& bytes)>& visit);

}  // namespace sonarsim
