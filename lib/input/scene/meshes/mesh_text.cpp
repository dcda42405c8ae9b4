#include "input/scene/meshes/mesh_text.h"

#include "core/text.h"

namespace sonarsim {

std::string_view take_word(std::string_view& text) {
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    const auto begin = std::ranges::find_if_not(text, is_blank);
    const std::string_view word(begin, std::find_if(begin, text.end(), is_blank));
    text = {word.end(), text.end()};
    return word;
}

std::string_view take_line(std::string_view& text) {
    const auto end = std::ranges::find_if(text, [](char c) { return c == '\r' || c == '\n'; });
    const std::string_view line(text.begin(), end);
    text.remove_prefix(line.size());
    text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
    return trim(line);
}

std::string mended_text(std::string_view text, const Location& file) {
    std::string out;
    out.reserve(text.size());
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = take_line(text);
        std::string_view rest = line;
        const std::string_view key = take_word(rest);
        // A comment that ends with a backslash would hide the next line.
        if (key.starts_with('#') || key == "vn" || key == "vt") continue;
        out += key == "v" ? key : line;
        if (key == "o" || key == "solid") {  // libassimp ends such a name at a blank
            const auto name = static_cast<std::ptrdiff_t>(trim(rest).size());
            std::replace_if(
                out.end() - name, out.end(), [](char c) { return c == ' ' || c == '\t'; },
                blank_of_name);
        }
        // libassimp takes no word that begins with a point for a number, and skips a vertex with
        // another count of numbers, whereby faces get others.
        int count = 0;
        rest = key == "v" ? rest.substr(0, rest.find('#')) : "";
        for (std::string_view word; !(word = take_word(rest)).empty(); ++count) {
            if (!parse_number(word))
                refuse({file.file, number}, "'{}' of a vertex is not a number",
                       printable(word.substr(0, 60)));
            out.append(word.starts_with('.') ? " 0" : " ").append(word);
        }
        if (key == "v" && count != 3 && count != 4 && count != 6)
            refuse({file.file, number},
                   "a vertex has {} numbers; expected x, y, z, and maybe a weight or a colour",
                   count);
        out += '\n';
    }
    return out;
}

}  // namespace sonarsim
