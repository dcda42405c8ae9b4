#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

// For folders that anybody may have filled: what a link in them names may be private, or not
// theirs.

namespace sonarsim {

/// InputError when the path is a symbolic link. `what` is what a user writes there: "a dataset".
void require_no_link(const std::filesystem::path& path, const std::string& what);

/// Up to `size` bytes of a file from `offset` on, fewer at its end. InputError when it is missing,
/// is a link or not a regular file, or cannot be read.
std::string read_bytes(const std::filesystem::path& path, std::size_t offset, std::size_t size);

/// Copies a file: a reader of `to` sees the old file or the whole new one, and a link there is
/// replaced. InputError as read_bytes() for `from`; std::system_error, which names `to`, when the
/// disk refuses.
void copy_regular_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace sonarsim
