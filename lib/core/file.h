#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sonarsim {

/// The bytes of a file that a user named. InputError when it is missing, is not a regular file,
/// cannot be read or is larger than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// Writes to a temporary name beside `path` and renames it: a reader sees the old file or the
/// whole new one. std::system_error when the disk does not take it; no temporary file is left then.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The name that a file bears until it is whole: a hidden sibling of `path`, so that a rename
/// stays within one file system, ".<name>.<process>.part", so that two processes may write the
/// same file.
std::filesystem::path temporary_name(const std::filesystem::path& path);

}  // namespace sonarsim
