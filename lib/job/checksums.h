#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "dataset/layout.h"
#include "job/journal.h"

namespace sonarsim {

/// Writes OUT/SHA256SUMS, as `sha256sum -c` takes it in OUT: every file of the dataset but this
/// one. Of loose files of pings the journal tells the sum, so that they need not be read again; the
/// others are read, but for dataset.json, which gets the text `description` afterwards.
/// std::runtime_error when the journal lacks a ping; std::system_error when a file cannot be read.
void write_checksums(const Layout& layout, const JournalEntries& entries,
                     const std::string& description);

/// The sums of a text like that by file, relative to OUT. InputError with the line for whatever is
/// not 64 hexadecimal digits, two blanks (or a blank and a star) and the name of a file below OUT.
std::map<std::string, std::string> parse_checksums(const std::string& text,
                                                   const std::string& file);

}  // namespace sonarsim
