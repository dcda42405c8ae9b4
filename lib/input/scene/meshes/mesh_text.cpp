#include "input/scene/meshes/mesh_text.h"

#include <algorithm>

#include "core/text.h"

namespace sonarsim {

namespace {

/// The next line without its end, which may be that of any system.
std::string_view take_any_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
    return line;
}

/// Writes the numbers of a vertex. libassimp takes no word that begins with a point for one, and
/// skips a vertex with another count, whereby faces get others.
void add_vertex(std::string_view numbers, const Location& where, std::string& out) {
    int count = 0;
    out += 'v';
    numbers = numbers.substr(0, numbers.find('#'));
    for (std::string_view word = take_word(numbers); !word.empty(); word = take_word(numbers)) {
        if (!parse_number(word))
            throw InputError(where,
                             "'" + printable(word.substr(0, 60)) + "' of a vertex is not a number");
        out.append(word.starts_with('.') ? " 0" : " ").append(word);
        ++count;
    }
    if (count == 3 || count == 4 || count == 6) return;
    throw InputError(where, "a vertex has " + std::to_string(count) +
                                " numbers; expected x, y, z, and maybe a weight or a colour");
}

}  // namespace

std::string_view take_word(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::size_t from = text.find_first_not_of(blanks);
    if (from == std::string_view::npos) return text = {};
    text.remove_prefix(from);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

std::string mended_obj(std::string text, const Location& file) {
    text = without_byte_order_mark(text);
    std::string_view rest = text;
    std::string out;
    out.reserve(text.size());
    // libassimp gives the faces before the first usemtl the material of that. This is its name for
    // none.
    if (rest.find("usemtl") != std::string_view::npos) out = "usemtl DefaultMaterial\n";
    for (int number = 1; !rest.empty(); ++number) {
        std::string_view line = take_any_line(rest);
        const std::string_view whole = trim(line);
        const std::string_view key = take_word(line);
        // A comment that ends with a backslash would hide the next line.
        if (key.starts_with('#') || key == "vn" || key == "vt") continue;
        if (key == "v")
            add_vertex(line, {file.file, number}, out);
        else
            out += whole;
        out += '\n';
    }
    return out;
}

}  // namespace sonarsim
