#include "core/csv.h"

#include "support/test.h"

TEST_CASE("CSV: fields are trimmed or quoted, and rows keep their line numbers") {
    const CsvTable table = parse_csv(
        "\xEF\xBB\xBF# made by hand\n\na, b ,c\r\n 1 ,2,\t3\n\n#x\n,,\n \"x, y\" , \"say "
        "\"\"no\"\"\",\"#c\"",
        "t.csv");
    CHECK(table.header.line == 3);
    CHECK(table.header.fields == std::vector<std::string>{"a", "b", "c"});
    REQUIRE(table.rows.size() == 3);
    CHECK(table.rows[0].line == 4);
    CHECK(table.rows[0].fields == std::vector<std::string>{"1", "2", "3"});
    CHECK(table.rows[1].line == 7);
    CHECK(table.rows[1].fields == std::vector<std::string>{"", "", ""});
    CHECK(table.rows[2].fields == std::vector<std::string>{"x, y", "say \"no\"", "#c"});
}

TEST_CASE("CSV: errors name file and line") {
    const std::pair<std::string, std::string> faulty[] = {
        {"", ": is empty; expected a header line"},
        {"# only\n\n", ": is empty; expected a header line"},
        {"a,b\n\n1,2,3\n", ":3: 3 fields, but the header in line 1 has 2"},
        {"a,b\n1\n", ":2: 1 fields, but the header in line 1 has 2"},
        {"a,b\n\"1,2\n", ":2: a quoted field is not closed on its line"},
        {"a,b\n\"1\"2,3\n", ":2: text after the closing quote of field '1'"},
        {"a,b\n1\"2,3\n", ":2: a quote inside of a field that does not start with one: 1\"2"},
        {{"a\0b", 3}, ": holds a zero byte; expected CSV as UTF-8 text"},
        {"a;b\n1,5;2\n",
         ":1: the header has no comma: fields are separated by ',', not by ';', and numbers "
         "have a decimal point"},
        {"a\tb\n",
         ":1: the header has no comma: fields are separated by ',', not by tabs, and numbers "
         "have a decimal point"},
        {"a,b\r1,2\r", ":1: lines end in CR alone; save the file with LF or CRLF"},
        {"a,b\n1,\xe9\n", ":2: is not UTF-8 text; save the file as UTF-8"},
        {{"II*\0\b", 5}, ": is a TIFF picture, such as a GeoTIFF, not a CSV"},
        {{"glTF\2\0", 6}, ": is a .glb mesh, not a CSV"},
        {std::string(1024, ','), ":1: more than 1024 fields"}};
    check_faults(faulty, "t.csv", [](const std::string& text) { parse_csv(text, "t.csv"); });
}
