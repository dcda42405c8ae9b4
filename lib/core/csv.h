#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

struct CsvRow {
    int line = 0;                     ///< line number in the file, from 1
    std::vector<std::string> fields;  ///< without blanks around them and without quotes
};

struct CsvTable {
    std::string file;
    CsvRow header;             ///< the first row that is not a comment
    std::vector<CsvRow> rows;  ///< each with as many fields as the header
};

/// Reads comma-separated text, row by row, the header first, since a whole table takes forty times
/// the memory of its text. Lines that start with '#' and blank lines are skipped; a byte order mark
/// and CRLF line ends are tolerated. A field may be quoted ("a, b"; "" is one quote), but may not
/// span lines. InputError with file:line for a missing header, a row with another number of fields
/// than the header, a misplaced quote, more than 1024 columns, or binary text.
void for_each_csv_row(std::string_view text, const std::string& file_name,
                      const std::function<void(CsvRow& row)>& visit);

/// All rows.
CsvTable parse_csv(std::string_view text, const std::string& file_name);

/// parse_csv of a file of at most `limit_bytes`.
CsvTable read_csv(const std::filesystem::path& path, std::size_t limit_bytes);

/// A field as text of a CSV, in quotes if it needs them.
std::string csv_field(const std::string& field);

}  // namespace sonarsim
