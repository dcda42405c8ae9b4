#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "dataset/layout.h"
#include "job/journal.h"

namespace sonarsim {

/// Writes OUT/SHA256SUMS for `sha256sum -c` in OUT: every file of the dataset but this one. Sums of
/// the pings' files come from the journal. The sum of dataset.json is that of `description`,
/// which is written to it afterwards. All other files are read. std::runtime_error when the journal
/// lacks a ping; std::system_error when a file cannot be read.
void write_checksums(const Layout& layout, const JournalEntries& entries,
                     const std::string& description);

/// A line of SHA256SUMS.
std::string checksum_line(const std::string& sum, const std::string& name);

/// Reads the sums in a SHA256SUMS by file, relative to its folder. InputError with the line for
/// anything but 64 hexadecimal digits, two blanks and the name of a file below that folder.
std::map<std::string, std::string> read_checksums(const std::filesystem::path& file);

}  // namespace sonarsim
