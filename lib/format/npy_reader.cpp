#include "format/npy_reader.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_dimensions = 4;
constexpr std::size_t most_header_bytes = std::size_t{1} << 16;
constexpr std::uint64_t most_npy_values = std::uint64_t{1} << 40;

[[noreturn]] void refuse_npy(const std::string& what) {
    throw std::runtime_error(what);
}

/// The text of the header, and where the data begin.
std::string_view npy_header_text(std::string_view bytes, std::size_t& data_at) {
    constexpr std::string_view magic("\x93NUMPY", 6);
    if (!bytes.starts_with(magic) || bytes.size() < 12) refuse_npy("is no .npy file");
    const auto byte = [&](std::size_t at) {
        return std::size_t{static_cast<unsigned char>(bytes[at])};
    };
    const bool is_first = byte(6) == 1;
    if (byte(6) < 1 || byte(6) > 3) refuse_npy("is a .npy file of an unknown version");
    const std::size_t begin = is_first ? 10 : 12;
    std::size_t length = byte(8) | byte(9) << 8;
    if (!is_first) length |= byte(10) << 16 | byte(11) << 24;
    if (length > most_header_bytes || bytes.size() - begin < length) refuse_npy("is cut off");
    data_at = begin + length;
    return bytes.substr(begin, length);
}

/// The text behind a key of the header.
std::string_view behind(std::string_view header, std::string_view key) {
    const std::size_t at = header.find(key);
    if (at == std::string_view::npos) refuse_npy("has a .npy header without " + std::string(key));
    return trim(header.substr(at + key.size()));
}

std::string type_of(std::string_view header) {
    const std::string_view text = behind(header, "'descr':");
    const std::size_t end = text.empty() ? 0 : text.find(text[0], 1);
    if (text.empty() || text[0] != '\'' || end == std::string_view::npos)
        refuse_npy("holds records, not numbers; save one array of them");
    std::string type(text.substr(1, end - 1));
    for (const char* known : {"|u1", "<u2", "<f4", "<f8"}) {
        if (type == known) return type;
    }
    refuse_npy("holds values of the type '" + printable(type.substr(0, 20)) +
               "'; save them as uint8, uint16, float32 or float64");
}

std::vector<std::size_t> shape_of_npy(std::string_view header) {
    std::string_view text = behind(header, "'shape':");
    const std::size_t end = text.find(')');
    if (!text.starts_with('(') || end == std::string_view::npos) refuse_npy("has no shape");
    text = text.substr(1, end - 1);
    std::vector<std::size_t> shape;
    while (!trim(text).empty()) {
        const std::size_t comma = text.find(',');
        const auto length = parse_unsigned(trim(text.substr(0, comma)));
        if (!length || shape.size() == most_dimensions)
            refuse_npy("has no shape of one to four lengths");
        shape.push_back(*length);
        text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
    }
    if (shape.empty()) refuse_npy("holds one number, not an array");
    return shape;
}

template <class T>
double number_in(std::string_view data, std::size_t index) {
    T value;
    std::memcpy(&value, data.data() + index * sizeof value, sizeof value);
    return static_cast<double>(value);
}

/// The index in an array in Fortran order of the value that has the number `k` in C order.
std::size_t fortran_index(const std::vector<std::size_t>& shape, std::size_t k) {
    std::array<std::size_t, most_dimensions> index{};
    for (std::size_t d = shape.size(); d-- > 0;) {
        index[d] = k % shape[d];
        k /= shape[d];
    }
    std::size_t at = 0;
    for (std::size_t d = shape.size(); d-- > 0;)
        at = at * shape[d] + index[d];
    return at;
}

}  // namespace

NpyView read_npy(std::string_view bytes) {
    std::size_t data_at = 0;
    const std::string_view header = npy_header_text(bytes, data_at);
    NpyView view;
    view.format.type = type_of(header);
    view.format.fortran_order = behind(header, "'fortran_order':").starts_with("True");
    view.format.shape = shape_of_npy(header);
    std::uint64_t values = 1;
    for (const std::size_t length : view.format.shape) {
        if (length == 0 || length > most_npy_values / values)
            refuse_npy("has no values, or too many");
        values *= length;
    }
    view.values = values;
    view.data = bytes.substr(data_at);
    const auto value_bytes = static_cast<std::size_t>(view.format.type[2] - '0');
    if (view.data.size() != view.values * value_bytes)
        refuse_npy("has " + std::to_string(view.data.size()) +
                   " bytes of values, where its shape needs " +
                   std::to_string(view.values * value_bytes));
    return view;
}

double npy_value(const NpyView& array, std::size_t k) {
    if (array.format.fortran_order) k = fortran_index(array.format.shape, k);
    const std::string& type = array.format.type;
    if (type == "|u1") return number_in<std::uint8_t>(array.data, k);
    if (type == "<u2") return number_in<std::uint16_t>(array.data, k);
    if (type == "<f4") return number_in<float>(array.data, k);
    return number_in<double>(array.data, k);
}

}  // namespace sonarsim
