#include "core/csv.h"

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_columns = 1024;

/// Reads a quoted field that starts at `line[at]` and moves `at` past the closing quote.
std::string read_quoted(std::string_view line, std::size_t& at, const Location& where) {
    std::string field;
    for (++at; at < line.size(); ++at) {
        if (line[at] != '"') {
            field += line[at];
        } else if (line.substr(at).starts_with("\"\"")) {
            field += line[at++];
        } else {
            ++at;
            return field;
        }
    }
    refuse(where, "a quoted field is not closed on its line");
}

std::vector<std::string> split_fields(std::string_view line, const Location& where) {
    std::vector<std::string> fields;
    std::size_t at = 0;
    while (true) {
        if (fields.size() == max_columns) refuse(where, "more than {} fields", max_columns);
        const std::size_t start = line.find_first_not_of(" \t", at);
        const bool is_quoted = start != std::string_view::npos && line[start] == '"';
        std::string field;
        if (is_quoted) field = read_quoted(line, at = start, where);
        const std::size_t next = line.find(',', at);
        const std::string_view rest = trim(line.substr(at, next - at));
        if (is_quoted && !rest.empty())
            refuse(where, "text after the closing quote of field '{}'", field);
        if (rest.find('"') != std::string_view::npos)
            refuse(where, "a quote inside of a field that does not start with one: {}", rest);
        fields.emplace_back(is_quoted ? trim(field) : rest);
        if (next == std::string_view::npos) return fields;
        at = next + 1;
    }
}

/// Throws InputError for a line of another encoding.
void check_utf8(std::string_view line, const Location& where) {
    while (!line.empty()) {
        const std::size_t length = utf8_length(line);
        if (length == 0) refuse(where, "is not UTF-8 text; save the file as UTF-8");
        line.remove_prefix(length);
    }
}

/// Throws InputError for a header whose fields are not separated by commas.
void check_header(std::string_view line, const Location& where) {
    if (line.find('\r') != std::string_view::npos)
        refuse(where, "lines end in CR alone; save the file with LF or CRLF");
    if (line.find(',') != std::string_view::npos) return;
    const std::size_t at = line.find_first_of(";\t ");
    if (at == std::string_view::npos) return;
    const char* const found = line[at] == ';' ? "';'" : line[at] == ' ' ? "blanks" : "tabs";
    refuse(where,
           "the header has no comma: fields are separated by ',', not by {}, and numbers have a "
           "decimal point",
           found);
}

}  // namespace

void for_each_csv_row(std::string_view text, const std::string& file_name,
                      const std::function<void(CsvRow& row)>& visit) {
    text = without_byte_order_mark(text);
    const Location file{file_name};
    const std::string_view format = known_format(text);
    if (!format.empty()) refuse(file, "is {}, not a CSV", format);
    if (text.find('\0') != std::string_view::npos)
        refuse(file, "holds a zero byte; expected CSV as UTF-8 text");
    std::size_t columns = 0;
    int header_line = 0;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.front() == '#') continue;

        const Location where{file_name, number};
        check_utf8(line, where);
        if (columns == 0) check_header(line, where);
        CsvRow row{number, split_fields(line, where)};
        if (columns == 0) {
            columns = row.fields.size();
            header_line = number;
        } else if (row.fields.size() != columns) {
            refuse(where, "{} fields, but the header in line {} has {}", row.fields.size(),
                   header_line, columns);
        }
        visit(row);
    }
    if (columns == 0) refuse(file, "is empty; expected a header line");
}

CsvTable parse_csv(std::string_view text, const std::string& file_name) {
    CsvTable table;
    table.file = file_name;
    for_each_csv_row(text, file_name, [&](CsvRow& row) {
        if (table.header.fields.empty()) {
            table.header = std::move(row);
        } else {
            table.rows.push_back(std::move(row));
        }
    });
    return table;
}

CsvTable read_csv(const std::filesystem::path& path, std::size_t limit_bytes) {
    return parse_csv(read_file(path, limit_bytes), path.string());
}

std::string csv_field(const std::string& field) {
    if (field.find_first_of(",\"# ") == std::string::npos) return field;
    std::string out = "\"";
    for (const char c : field)
        out.append(c == '"' ? 2 : 1, c);
    return out + "\"";
}

}  // namespace sonarsim
