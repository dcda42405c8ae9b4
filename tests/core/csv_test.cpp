#include "core/csv.h"

#include <doctest/doctest.h>

#include <string>

#include "core/error.h"

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("CSV: fields are trimmed and rows keep their line numbers") {
        const CsvTable table =
            parse_csv("# made by hand\n\na, b ,c\n 1 ,2,\t3\n\n#x\n4,5,6", "t.csv");
        CHECK(table.file == "t.csv");
        CHECK(table.header.line == 3);
        CHECK(table.header.fields == std::vector<std::string>{"a", "b", "c"});
        REQUIRE(table.rows.size() == 2);
        CHECK(table.rows[0].line == 4);
        CHECK(table.rows[0].fields == std::vector<std::string>{"1", "2", "3"});
        CHECK(table.rows[1].line == 7);
        CHECK(table.rows[1].fields == std::vector<std::string>{"4", "5", "6"});
    }

    TEST_CASE("CSV: a byte order mark and CRLF are no part of a field") {
        const CsvTable table = parse_csv(
            "\xEF\xBB\xBF"
            "a,b\r\n1,2\r\n",
            "t.csv");
        CHECK(table.header.fields == std::vector<std::string>{"a", "b"});
        CHECK(table.rows.at(0).fields == std::vector<std::string>{"1", "2"});
    }

    TEST_CASE("CSV: empty fields and a comma at the end count as fields") {
        const CsvTable table = parse_csv("a,b,c\n,,\n", "t.csv");
        CHECK(table.rows.at(0).fields == std::vector<std::string>{"", "", ""});
    }

    TEST_CASE("CSV: quoted fields hold commas and quotes") {
        const CsvTable table =
            parse_csv("a,b\n \"x, y\" , \"say \"\"no\"\"\"\n\"#c\",\"\"\n", "t.csv");
        CHECK(table.rows.at(0).fields == std::vector<std::string>{"x, y", "say \"no\""});
        CHECK(table.rows.at(1).fields == std::vector<std::string>{"#c", ""});
    }

    TEST_CASE("CSV: errors name file and line") {
        const auto parse = [](const std::string& text) { parse_csv(text, "t.csv"); };
        CHECK_THROWS_WITH_AS(parse(""), "t.csv: is empty; expected a header line", InputError);
        CHECK_THROWS_WITH_AS(parse("# only\n\n"), "t.csv: is empty; expected a header line",
                             InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\n\n1,2,3\n"),
                             "t.csv:3: 3 fields, but the header in line 1 has 2", InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\n1\n"), "t.csv:2: 1 fields, but the header in line 1 has 2",
                             InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\n\"1,2\n"),
                             "t.csv:2: a quoted field is not closed on its line", InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\n\"1\"2,3\n"),
                             "t.csv:2: text after the closing quote of field '1'", InputError);
        CHECK_THROWS_WITH_AS(
            parse("a,b\n1\"2,3\n"),
            "t.csv:2: a quote inside of a field that does not start with one: 1\"2", InputError);
        CHECK_THROWS_WITH_AS(parse(std::string("a\0b", 3)),
                             "t.csv: holds a zero byte; expected CSV as UTF-8 text", InputError);
        CHECK_THROWS_WITH_AS(
            parse("a;b\n1,5;2\n"),
            "t.csv:1: the header has no comma: fields are separated by ',', not by "
            "';', and numbers have a decimal point",
            InputError);
        CHECK_THROWS_WITH_AS(
            parse("a\tb\n"),
            "t.csv:1: the header has no comma: fields are separated by ',', not by "
            "tabs, and numbers have a decimal point",
            InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\r1,2\r"),
                             "t.csv:1: lines end in CR alone; save the file with LF or CRLF",
                             InputError);
        CHECK_THROWS_WITH_AS(parse("a,b\n1,\xe9\n"),
                             "t.csv:2: is not UTF-8 text; save the file as UTF-8", InputError);
        CHECK_THROWS_WITH_AS(parse(std::string("II*\0\b", 5)),
                             "t.csv: is a TIFF picture, such as a GeoTIFF, not a CSV", InputError);
        CHECK_THROWS_WITH_AS(parse(std::string("glTF\2\0", 6)), "t.csv: is a .glb mesh, not a CSV",
                             InputError);
        CHECK_THROWS_WITH_AS(parse(std::string(1024, ',')), "t.csv:1: more than 1024 fields",
                             InputError);
        CHECK_THROWS_AS(read_csv("/nonexistent/t.csv", 100), InputError);
    }
}
