#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "dataset/layout.h"
#include "job/journal.h"

namespace sonarsim {

/// Writes OUT/SHA256SUMS, as `sha256sum -c` takes it in OUT: every file of the dataset but this
/// one. The journal has the sums of loose files of pings, so that these need not be read again; the
/// others are read, but for dataset.json, which gets the text `description` afterwards.
/// std::runtime_error when the journal lacks a ping; std::system_error when a file cannot be read.
void write_checksums(const Layout& layout, const JournalEntries& entries,
                     const std::string& description);

/// A line of SHA256SUMS.
std::string checksum_line(const std::string& sum, const std::string& name);

/// Reads the sums in a SHA256SUMS by file, relative to its folder. InputError with the line for
/// anything but 64 hexadecimal digits, two blanks and the name of a file below that folder.
std::map<std::string, std::string> read_checksums(const std::filesystem::path& file);

}  // namespace sonarsim
