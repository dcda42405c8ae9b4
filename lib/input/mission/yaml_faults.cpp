#include "input/mission/yaml_faults.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sonarsim {

namespace {

/// The line with this number, counted from 0.
std::string_view line_of(std::string_view text, int number) {
    for (; number > 0 && text.find('\n') != std::string_view::npos; --number)
        text.remove_prefix(text.find('\n') + 1);
    return number > 0 ? std::string_view() : text.substr(0, text.find('\n'));
}

}  // namespace

std::string cause_of(const std::string& fault, int line_number, std::string_view text) {
    // The parser reports some faults one line too late.
    for (const int number : {line_number, std::max(0, line_number - 1)}) {
        const std::string_view line = line_of(text, number);
        const std::string_view indentation = line.substr(0, line.find_first_not_of(" \t"));
        if (indentation.find('\t') != std::string_view::npos)
            return "a tab in the indentation; indent by blanks";
        if (line.find("\xC2\xA0") != std::string_view::npos)
            return "a no-break space; write an ordinary blank";
    }
    constexpr std::array<std::pair<std::string_view, const char*>, 6> causes{
        {{"illegal map value",
          "a second ':' in one value; check the indentation of this line, and that a blank follows "
          "the ':' of the line above"},
         {"illegal flow end", "a bracket or brace above is not closed"},
         {"end of map flow not found", "a brace is not closed"},
         {"end of sequence flow not found", "a bracket is not closed"},
         {"end of map not found", "this line is not indented as the lines above it"},
         {"end of sequence not found", "this line is not indented as the lines above it"}}};
    for (const auto& [theirs, ours] : causes) {
        if (fault.starts_with(theirs)) return ours;
    }
    return fault;
}

bool is_closed(std::string_view text, std::size_t at) {
    const char quote = text[at];
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == quote) return true;
        if (quote == '"' && text[i] == '\\') ++i;
    }
    return false;
}

}  // namespace sonarsim
