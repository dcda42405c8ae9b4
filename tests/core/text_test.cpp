#include "core/text.h"

#include "support/test.h"

TEST_CASE("text: control characters are escaped") {
    CHECK(printable("Steel plate 3\" \\ \xc3\xa9\xe6\xb0\xb4") ==
          "Steel plate 3\" \\ \xc3\xa9\xe6\xb0\xb4");
    CHECK(printable("\x1b[2J\r\n\t\x7f") == "\\x1b[2J\\x0d\\x0a\\x09\\x7f");
    CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
    CHECK(printable("\xc2\x9b"
                    "2J") ==
          "\\xc2\\x9b"
          "2J");  // U+009B is an ESC [ in one character
    CHECK(printable("\xff\xc3") == "\\xff\\xc3");
}

TEST_CASE("text: a number is the whole of the text, in decimal") {
    CHECK(parse_number("1") == 1.0);
    CHECK(parse_number("+1.5") == 1.5);
    CHECK(parse_number("-2.5e-3") == -0.0025);
    CHECK(parse_number(".5") == 0.5);
    CHECK(parse_number("010") == 10.0);  // not octal
    CHECK(parse_number("inf") == std::numeric_limits<double>::infinity());
    CHECK(std::isnan(parse_number("nan").value()));

    for (const char* text : {"", " ", " 1", "1 ", "1x", "0x10", "1,5", "1.5.2", "+", "-", "+-1",
                             "++1", "--1", "e5", "1e", "1e999", "one", "1_000"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_number(text).has_value());
    }
    CHECK_FALSE(parse_number(std::string_view("1\0", 2)).has_value());
}

TEST_CASE("text: integers refuse what is not one or does not fit") {
    CHECK(parse_integer("-7") == -7);
    CHECK(parse_integer("+7") == 7);
    CHECK(parse_integer("010") == 10);
    CHECK(parse_integer("9223372036854775807") == std::numeric_limits<std::int64_t>::max());
    CHECK(parse_unsigned("18446744073709551615") == std::numeric_limits<std::uint64_t>::max());
    for (const char* text : {"", "1.0", "1e3", "0x10", " 1", "1 ", "9223372036854775808", "+-1"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_integer(text).has_value());
    }
    for (const char* text : {"", "-1", "-0x1", "1.0", "18446744073709551616"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_unsigned(text).has_value());
    }
}

TEST_CASE("text: a number's text is short and reads back as the same number") {
    CHECK(number_text(0.1) == "0.1");
    CHECK(number_text(3.0) == "3");
    // The longest doubles: 17 digits, sign and a three-digit exponent.
    for (const double value : {1.0 / 3.0, -2.2250738585072014e-308, 4.9406564584124654e-324,
                               -1.7976931348623157e308, 0.1 + 0.2}) {
        CAPTURE(value);
        CHECK(parse_number(number_text(value)) == value);
    }
}

TEST_CASE("text: did_you_mean names the nearest candidate, or none when all are far") {
    const std::vector<std::string> keys{"range_min_m", "range_max_m", "azimuth_deg", "every"};
    CHECK(did_you_mean("range_mx_m", keys) == " (did you mean 'range_max_m'?)");
    CHECK(did_you_mean("azimut_deg", keys) == " (did you mean 'azimuth_deg'?)");
    CHECK(did_you_mean("evry", keys) == " (did you mean 'every'?)");
    // Four edits in five letters make another word; at most a third of the letters may differ.
    CHECK(did_you_mean("water", keys) == "");
    CHECK(did_you_mean("", keys) == "");
    CHECK(did_you_mean("every", {}) == "");
    // Long words are not compared: the table of distances grows with the word.
    CHECK(did_you_mean(std::string(65, 'e'), std::vector<std::string>{std::string(66, 'e')}) == "");
}
