#include "input/mission/document.h"

#include "mission/fixtures.h"

namespace {

std::string repeated(const std::string& piece, std::size_t bytes) {
    std::string out;
    while (out.size() + piece.size() <= bytes)
        out += piece;
    return out;
}

const std::string bracket = "a bracket is not closed, or a list or map stands where a key must";

}  // namespace

TEST_CASE("duplicate keys, and what YAML can do and a mission may not") {
    const std::string anchors = "anchors (&name) are not supported; write the value out";
    check_refused(
        "",
        {{"seed: 1\nname: x\nseed: 2\n", "3:1: duplicate key 'seed'; first in line 1"},
         {"{seed: 1, \"seed\": 2}\n", "1:11: duplicate key 'seed'; first in line 1"},
         {"sensors:\n  a: {}\n  a: {}\n", "3:3: duplicate key 'a'; first in line 2"},
         {"a: &x 1\nb: *x\n", "1:4: " + anchors},
         {"a: &x [&y [1], *y]\n", "1:4: " + anchors},
         {"a: *x\n", "1:4: not valid YAML: the referenced anchor is not defined"},
         {"a: !!str 1\n", "1:4: tags (!name) are not supported"},
         {"a: !mine {}\n", "1:4: tags (!name) are not supported"},
         {"? [a]\n: 1\n", "1:3: " + bracket},
         {"{{a: 1}: 1}\n", "1:2: " + bracket},
         {"~: 1\n", "1:1: a key must be text"},
         {": 1\n", "1:1: a key must be text"},
         {smallest_mission + "---\nseed: 1\n", "6:1: a second YAML document; only one is read"}});
    CHECK(refusal("---\n" + smallest_mission + "...\n") == "");
    CHECK(refusal("\xef\xbb\xbf" + smallest_mission) == "");  // a byte order mark is no fault
}

TEST_CASE("malformed YAML names its line") {
    const std::string two_colons =
        "not valid YAML: a second ':' in one value; check the indentation of this line, and that a "
        "blank follows the ':' of the line above";
    const std::string tab = "not valid YAML: a tab in the indentation; indent by blanks";
    check_refused("", {{"seed: 1\nname: [1, 2\n", "3:1: not valid YAML: a bracket is not closed"},
                       {"seed: 1\nname: {a: 2\n", "3:1: not valid YAML: a brace is not closed"},
                       {"seed: 1\n name: 2\n", "2:6: " + two_colons},
                       {"seed:1\nname: 2\n", "2:5: " + two_colons},
                       {"water:\n  ph: 8\n wind_m_s: 3\n",
                        "3:2: not valid YAML: this line is not indented as the lines above it"},
                       {"seed: \"abc\nname: b\n", "1:7: this quote is not closed"},
                       {"seed: 'abc\n", "1:7: this quote is not closed"},
                       {"\tseed: 1\n", "1:6: " + tab},
                       {"seed:\u00a01\nname: a\n",
                        "2:5: not valid YAML: a no-break space; write an ordinary blank"}});
    CHECK(refusal("water:\n  ph: 8\n\twind_m_s: 3\n").ends_with(tab));
    CHECK(refusal("a: }\n").starts_with("m.yaml:1:"));
}

TEST_CASE("text that is not UTF-8 or holds control characters") {
    // A lone byte, overlong, a surrogate, above U+10FFFF, cut off.
    for (const char* bad : {"\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe4\xbd"}) {
        CHECK(refusal("seed: 1\nname: a" + std::string(bad)) ==
              "m.yaml:2:8: is not UTF-8 text; save the file as UTF-8");
    }
    CHECK(refusal("\xff\xfes") == "m.yaml:1:1: is not UTF-8 text; save the file as UTF-8");
    // yaml-cpp would end the file here and render without what follows.
    CHECK(refusal(smallest_mission + "\x04seed: 5\n") ==
          "m.yaml:6:1: control character in the text");
    CHECK(refusal(std::string("seed: 1\n\0", 9)) == "m.yaml:2:1: control character in the text");
    std::string windows;
    for (const char c : smallest_mission)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(yaml_of(parse(windows)) == yaml_of(parse(smallest_mission)));
}

TEST_CASE("depth and size end early, whatever the text nests") {
    const std::size_t bytes = std::size_t{1} << 17;
    for (const char* piece :
         {"[",     "{",       "- ",    "? ",  "{a: ",       "[a: ",      "!a ", "&a ", "? - ",
          "- ? ",  ": ",      "a: ",   "[,",  "{,",         "- - \n",    "\"",  "'",   "|",
          ">",     "#",       "%",     "[\n", "]",          "}",         "*a ", "\\",  "\"\\x",
          "---\n", "--- |\n", "a:\n ", "a\n", "{a\n",       "[?",        "[:",  "{?",  "{:",
          "\n",    " ",       "\r",    "\t",  "%TAG ! a\n", "a: 'b\n\n", "'\n"}) {
        CAPTURE(piece);
        CHECK(refusal(repeated(piece, bytes)) != "");
        CHECK(refusal(smallest_mission + "water: " + repeated(piece, bytes - 200)) != "");
    }

    CHECK(refusal(std::string(100'000, '[')) == "m.yaml:1:1: " + bracket);
    CHECK(refusal(std::string(17, '[') + std::string(17, ']')) ==
          "m.yaml:1:17: nested deeper than 16 levels");
    CHECK(refusal(std::string(16, '[') + std::string(16, ']')).find("nested") == std::string::npos);
    std::string deep;
    for (int i = 0; i < 20; ++i)
        deep += std::string(i, ' ') + "a:\n";
    CHECK(refusal(deep) == "m.yaml:17:17: nested deeper than 16 levels");
    CHECK(refusal("a: [" + repeated("0,", 600'000) + "]\n")
              .find("more than 250000 values; long trajectories") != std::string::npos);
}

TEST_CASE("messages stay short and printable") {
    CHECK(in_quotes("a\nb\x1b") == "'a?b?'");
    CHECK(shown("abcdef", 6) == "abcdef");
    CHECK(shown("abcdefg", 6) == "abcdef...");
    CHECK(shown("abc\xc3\xa4", 4) == "abc...");  // no half character
}
