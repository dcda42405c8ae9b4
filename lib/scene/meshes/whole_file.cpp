#include "scene/meshes/whole_file.h"

#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr const char* cut_off = "; it was cut off: copy or export it again";

/// The next word behind blanks; "" at the end.
std::string_view take_word(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::size_t from = text.find_first_not_of(blanks);
    if (from == std::string_view::npos) return text = {};
    text.remove_prefix(from);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return trim(line);
}

enum class PlyForm { ascii, little_endian, big_endian };

struct PlyType {
    std::size_t bytes = 0;
    bool is_signed = false;
};

struct PlyProperty {
    std::optional<PlyType> count;  ///< none: the property is no list
    PlyType value;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties = {};
};

struct PlyHeader {
    PlyForm form = PlyForm::ascii;
    std::vector<PlyElement> elements = {};
};

std::optional<PlyType> type_of(std::string_view name) {
    struct Named {
        std::string_view name;
        PlyType type;
    };
    constexpr std::array<Named, 16> types{{{"char", {1, true}},
                                           {"uchar", {1, false}},
                                           {"int8", {1, true}},
                                           {"uint8", {1, false}},
                                           {"short", {2, true}},
                                           {"ushort", {2, false}},
                                           {"int16", {2, true}},
                                           {"uint16", {2, false}},
                                           {"int", {4, true}},
                                           {"uint", {4, false}},
                                           {"int32", {4, true}},
                                           {"uint32", {4, false}},
                                           {"float", {4, true}},
                                           {"float32", {4, true}},
                                           {"double", {8, true}},
                                           {"float64", {8, true}}}};
    for (const Named& known : types) {
        if (known.name == name) return known.type;
    }
    return std::nullopt;
}

/// Reads a line of the file's header into `header`. False if the line is faulty.
bool read_line(std::string_view line, PlyHeader& header) {
    const std::string_view key = take_word(line);
    if (key == "comment" || key == "obj_info" || key == "ply") return true;
    if (key == "format") {
        const std::string_view form = take_word(line);
        if (form == "binary_little_endian") header.form = PlyForm::little_endian;
        if (form == "binary_big_endian") header.form = PlyForm::big_endian;
        return form == "ascii" || header.form != PlyForm::ascii;
    }
    if (key == "element") {
        const std::string_view name = take_word(line);
        const auto count = parse_unsigned(take_word(line));
        if (count) header.elements.push_back({std::string(name), *count});
        return count.has_value();
    }
    if (key != "property" || header.elements.empty()) return false;
    PlyProperty property;
    std::string_view name = take_word(line);
    if (name == "list") {
        property.count = type_of(take_word(line));
        if (!property.count) return false;
        name = take_word(line);
    }
    const auto type = type_of(name);
    if (!type) return false;
    property.value = *type;
    header.elements.back().properties.push_back(property);
    return true;
}

/// Takes the header from the front of `bytes`.
PlyHeader take_header(std::string_view& bytes, const std::string& file) {
    PlyHeader header;
    for (int number = 1;; ++number) {
        const Location where{file, number};
        if (bytes.empty())
            throw InputError(where,
                             std::string("the header of the PLY has no end_header") + cut_off);
        const std::string_view line = take_line(bytes);
        if (number == 1 && line != "ply")
            throw InputError(where, "is no PLY: its first line is not 'ply'");
        if (line == "end_header") break;
        if (!read_line(line, header)) {
            throw InputError(
                where, "'" + printable(line.substr(0, 100)) + "' is no line of a PLY's header");
        }
    }
    for (const PlyElement& element : header.elements) {
        if (!element.properties.empty()) continue;
        throw InputError(Location{file},
                         "element '" + printable(element.name) + "' of the PLY has no property");
    }
    return header;
}

/// Walks over the values behind a header. Each call is false at the end of the file.
class PlyBody {
  public:
    PlyBody(std::string_view bytes, PlyForm form) : left_(bytes), form_(form) {}

    bool skip(const PlyType& type, std::uint64_t count) {
        if (form_ == PlyForm::ascii) {
            for (std::uint64_t i = 0; i < count; ++i) {
                if (take_word(left_).empty()) return false;
            }
            return true;
        }
        if (count > left_.size() / type.bytes) return false;
        left_.remove_prefix(count * type.bytes);
        return true;
    }

    bool skip_list(const PlyType& count_type, const PlyType& type) {
        const std::optional<std::uint64_t> count =
            form_ == PlyForm::ascii ? parse_unsigned(take_word(left_)) : take_integer(count_type);
        return count && skip(type, *count);
    }

  private:
    /// The count of a list; nothing at the end of the file and for a negative count.
    std::optional<std::uint64_t> take_integer(const PlyType& type) {
        if (type.bytes > 4 || left_.size() < type.bytes) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t at = form_ == PlyForm::big_endian ? i : type.bytes - 1 - i;
            value = value << 8U | static_cast<unsigned char>(left_[at]);
        }
        left_.remove_prefix(type.bytes);
        const bool is_negative = type.is_signed && (value >> (8 * type.bytes - 1)) != 0;
        return is_negative ? std::nullopt : std::optional(value);
    }

    std::string_view left_;
    PlyForm form_;
};

bool skip_element(PlyBody& body, const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
        const bool is_there = property.count ? body.skip_list(*property.count, property.value)
                                             : body.skip(property.value, 1);
        if (!is_there) return false;
    }
    return true;
}

}  // namespace

std::string_view whole_stl(std::string_view bytes, const std::string& file) {
    constexpr std::size_t head = 84;
    constexpr std::size_t triangle_bytes = 50;
    const Location where{file};
    std::uint32_t claimed = 0;
    if (bytes.size() >= head) std::memcpy(&claimed, bytes.data() + head - 4, sizeof(claimed));
    const std::size_t size = head + triangle_bytes * claimed;
    // Binary files may begin with "solid", too: then the claimed size decides.
    std::string_view rest = bytes;
    const bool may_be_text = take_word(rest) == "solid";
    if (may_be_text && size != bytes.size()) {
        if (bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 4096))
                .rfind("endsolid") == std::string_view::npos)
            throw InputError(where, std::string("the STL has no endsolid") + cut_off);
        return bytes;
    }
    if (bytes.size() < head) throw InputError(where, "is no STL: it is too short for one");
    if (size > bytes.size()) {
        throw InputError(where, "is no STL, or its end is missing: it claims " +
                                    std::to_string(claimed) + " triangles, which take " +
                                    std::to_string(size) + " bytes, and has " +
                                    std::to_string(bytes.size()) + "; copy or export it again");
    }
    return bytes.substr(0, size);
}

void require_whole_ply(std::string_view bytes, const std::string& file) {
    const PlyHeader header = take_header(bytes, file);
    PlyBody body(bytes, header.form);
    for (const PlyElement& element : header.elements) {
        // libassimp reads only the first triangle of a strip.
        if (element.name == "tristrips" && element.count > 0) {
            throw InputError(Location{file},
                             "has its surface as strips of triangles (tristrips), which are not "
                             "read; save it with faces, as MeshLab does");
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (skip_element(body, element)) continue;
            throw InputError(Location{file}, "element '" + printable(element.name) +
                                                 "' of the PLY ends or is faulty in number " +
                                                 std::to_string(i + 1) + " of " +
                                                 std::to_string(element.count) +
                                                 "; copy or export the file again");
        }
    }
}

}  // namespace sonarsim
