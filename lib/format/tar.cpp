#include "format/tar.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "core/file.h"

namespace sonarsim {

namespace {

constexpr std::size_t block = 512;
using Block = std::array<char, block>;

/// A field of a header. Numbers are octal digits that end in a zero byte.
struct Field {
    std::size_t begin;
    std::size_t bytes;
};
constexpr Field name_field{0, 100};
constexpr Field mode_field{100, 8};
constexpr Field owner_field{108, 8};
constexpr Field group_field{116, 8};
constexpr Field size_field{124, 12};
constexpr Field time_field{136, 12};
constexpr Field sum_field{148, 8};
constexpr Field type_field{156, 1};
constexpr Field magic_field{257, 8};
/// The largest number with eleven octal digits.
constexpr std::uint64_t largest_member = (std::uint64_t{1} << 33) - 1;
constexpr std::string_view magic{"ustar\00000", 8};

void put(Block& header, const Field& field, std::string_view text) {
    std::ranges::copy(text, header.begin() + static_cast<std::ptrdiff_t>(field.begin));
}

void put_number(Block& header, const Field& field, std::uint64_t value) {
    for (std::size_t digit = field.begin + field.bytes - 1; digit-- > field.begin; value /= 8)
        header[digit] = static_cast<char>('0' + value % 8);
}

std::string_view get(const Block& header, const Field& field) {
    const std::string_view text(header.data() + field.begin, field.bytes);
    return text.substr(0, text.find('\0'));
}

/// The sum of a header's bytes; the bytes of the sum itself count as blanks.
std::uint64_t sum_of(Block header) {
    std::fill_n(header.begin() + sum_field.begin, sum_field.bytes, ' ');
    return std::accumulate(
        header.begin(), header.end(), std::uint64_t{0},
        [](std::uint64_t sum, char byte) { return sum + static_cast<unsigned char>(byte); });
}

Block header_of(std::string_view name, std::uint64_t bytes) {
    if (name.size() > name_field.bytes || bytes > largest_member)
        throw std::logic_error("a tar archive cannot hold " + std::string(name));
    Block header{};
    put(header, name_field, name);
    put_number(header, mode_field, 0644);
    put_number(header, owner_field, 0);
    put_number(header, group_field, 0);
    put_number(header, size_field, bytes);
    put_number(header, time_field, 0);
    put(header, type_field, "0");
    put(header, magic_field, magic);
    put_number(header, {sum_field.begin, sum_field.bytes - 1}, sum_of(header));
    header[sum_field.begin + sum_field.bytes - 1] = ' ';
    return header;
}

}  // namespace

std::uint64_t tar_bytes(std::uint64_t file_bytes) {
    return block + (std::min(file_bytes, largest_member + 1) + block - 1) / block * block;
}

void append_to_tar(std::string& archive, std::string_view name, std::string_view bytes) {
    const Block header = header_of(name, bytes.size());
    archive.append(header.data(), block).append(bytes);
    archive.append(tar_bytes(bytes.size()) - block - bytes.size(), '\0');
}

void for_each_in_tar(
    const std::filesystem::path& path,
    const std::function<void(const std::string& name, const std::string& bytes)>& visit) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw_errno("cannot read", path);
    std::uint64_t left = std::filesystem::file_size(path);
    const auto read = [&](char* to, std::size_t bytes) {
        if (bytes > left) throw std::runtime_error("is cut off");
        if (!file.read(to, static_cast<std::streamsize>(bytes))) throw_errno("cannot read", path);
        left -= bytes;
    };
    Block header{};
    for (read(header.data(), block); header != Block{}; read(header.data(), block)) {
        std::uint64_t bytes = 0;
        for (const char digit : get(header, size_field)) {
            if (digit < '0' || digit > '7') throw std::runtime_error("is no tar archive");
            bytes = 8 * bytes + static_cast<std::uint64_t>(digit - '0');
        }
        const std::string name(get(header, name_field));
        // header_of() throws std::logic_error beyond largest_member: check the size first.
        if (bytes > left) throw std::runtime_error("is cut off");
        if (bytes > largest_member || header != header_of(name, bytes))
            throw std::runtime_error("is no archive of ours");
        std::string content(bytes, '\0');
        read(content.data(), bytes);
        Block padding{};
        read(padding.data(), tar_bytes(bytes) - block - bytes);
        visit(name, content);
    }
    read(header.data(), tar_end_bytes - block);
    if (left > 0) throw std::runtime_error("has bytes after its end");
}

}  // namespace sonarsim
