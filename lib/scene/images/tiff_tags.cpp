#include "scene/images/tiff_tags.h"

#include <array>
#include <bit>
#include <cstddef>
#include <fstream>
#include <string_view>

#include "core/error.h"

namespace sonarsim {

namespace {

/// More values than any tag of a map has. Tags of tiles have the most values.
constexpr std::uint64_t most_tag_values = 1 << 22;

/// Reads numbers of either byte order from a file.
class TiffBytes {
  public:
    explicit TiffBytes(const std::filesystem::path& path)
        : path_(path), file_(path, std::ios::binary) {}

    bool is_big_endian = false;

    std::string at(std::uint64_t offset, std::size_t count) {
        std::string bytes(count, '\0');
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(offset & 0x7FFFFFFFFFFFFFFFULL));
        file_.read(bytes.data(), static_cast<std::streamsize>(count));
        if (static_cast<std::size_t>(file_.gcount()) == count) return bytes;
        throw InputError(Location{path_.string()},
                         "its list of tags reaches beyond the end of the file, which was cut off "
                         "or damaged: copy or export it again");
    }

    std::uint64_t number(std::string_view bytes) const {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const std::size_t k = is_big_endian ? i : bytes.size() - 1 - i;
            value = value << 8 | static_cast<unsigned char>(bytes[k]);
        }
        return value;
    }

    std::uint64_t number_at(std::uint64_t offset, std::size_t bytes) {
        return number(at(offset, bytes));
    }

  private:
    const std::filesystem::path& path_;
    std::ifstream file_;
};

/// The bytes of one value of a type; 0 for a type that tags of maps do not have.
std::size_t bytes_of_type(std::uint64_t type) {
    constexpr std::array<std::size_t, 19> sizes{0, 1, 1, 2, 4, 0, 1, 0, 0, 0,
                                                0, 4, 8, 0, 0, 0, 8, 0, 8};
    return type < sizes.size() ? sizes[type] : 0;
}

double value_of(const TiffBytes& file, std::string_view bytes, std::uint64_t type) {
    constexpr std::uint64_t float_type = 11;
    constexpr std::uint64_t double_type = 12;
    const std::uint64_t number = file.number(bytes);
    if (type == float_type) return std::bit_cast<float>(static_cast<std::uint32_t>(number));
    if (type == double_type) return std::bit_cast<double>(number);
    return static_cast<double>(number);
}

void store_tag(const TiffBytes& file, std::uint16_t tag, std::uint64_t type, std::string_view bytes,
               TiffTags& tags) {
    constexpr std::uint64_t text_type = 2;
    if (type == text_type) {
        tags.texts[tag] = std::string(bytes.substr(0, bytes.find('\0')));
        return;
    }
    std::vector<double>& values = tags.numbers[tag];
    const std::size_t size = bytes_of_type(type);
    for (std::size_t i = 0; i + size <= bytes.size(); i += size)
        values.push_back(value_of(file, bytes.substr(i, size), type));
}

/// The sizes in the lists of tags of a file, one list for each of its images. Counts and offsets
/// have 8 bytes in a BigTIFF and 4 in a TIFF. The count of a TIFF's list has 2.
struct TiffLists {
    std::size_t word = 4;
    std::size_t counter = 2;
    std::uint64_t first = 0;  ///< the place of the first list

    std::size_t entry_bytes() const { return 4 + 2 * word; }
    /// The place of an entry of a list; behind the last one stands the place of the next list.
    std::uint64_t entry_at(std::uint64_t list, std::uint64_t i) const {
        return list + counter + i * entry_bytes();
    }
};

TiffLists open_lists(TiffBytes& file) {
    const std::string start = file.at(0, 4);
    file.is_big_endian = start[0] == 'M';
    const bool is_big = start[0] == 'M' ? start[3] == '+' : start[2] == '+';
    TiffLists lists;
    if (is_big) lists.word = lists.counter = 8;
    lists.first = file.number_at(is_big ? 8 : 4, lists.word);
    return lists;
}

}  // namespace

bool is_tiff(const std::filesystem::path& path) {
    using namespace std::literals;
    std::array<char, 4> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    const std::string_view bytes(start.data(), start.size());
    return bytes == "II*\0"sv || bytes == "MM\0*"sv || bytes == "II+\0"sv || bytes == "MM\0+"sv;
}

TiffTags read_tiff_tags(const std::filesystem::path& path, const std::set<std::uint16_t>& wanted) {
    TiffBytes file(path);
    const TiffLists lists = open_lists(file);
    const std::size_t word = lists.word;
    const std::uint64_t count = file.number_at(lists.first, lists.counter);
    TiffTags tags;
    tags.is_big_endian = file.is_big_endian;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t at = lists.entry_at(lists.first, i);
        const std::string entry = file.at(at, lists.entry_bytes());
        const std::string_view bytes = entry;
        const auto tag = static_cast<std::uint16_t>(file.number(bytes.substr(0, 2)));
        if (!wanted.contains(tag)) continue;
        const std::uint64_t type = file.number(bytes.substr(2, 2));
        const std::uint64_t values = file.number(bytes.substr(4, word));
        const std::size_t size = bytes_of_type(type);
        if (size == 0 || values > most_tag_values) continue;
        const std::size_t total = size * values;
        const std::string_view field = bytes.substr(4 + word, word);
        const std::string far = total > word ? file.at(file.number(field), total) : "";
        tags.places[tag] = total > word ? file.number(field) : at + 4 + word;
        store_tag(file, tag, type, total > word ? std::string_view(far) : field.substr(0, total),
                  tags);
    }
    return tags;
}

bool has_tiff_mask(const std::filesystem::path& path) {
    constexpr std::uint64_t subfile_tag = 254;  // NewSubfileType
    constexpr std::uint64_t is_mask = 4;
    constexpr int most_images = 64;  // more than a map has with its overviews
    TiffBytes file(path);
    const TiffLists lists = open_lists(file);
    std::uint64_t list = lists.first;
    for (int image = 0; list != 0 && image < most_images; ++image) {
        const std::uint64_t count = file.number_at(list, lists.counter);
        // The tags are in ascending order, and this is the first that there is.
        if (count > 0 && file.number_at(lists.entry_at(list, 0), 2) == subfile_tag) {
            const std::uint64_t field = lists.entry_at(list, 0) + 4 + lists.word;
            if ((file.number_at(field, 4) & is_mask) != 0) return true;
        }
        list = file.number_at(lists.entry_at(list, count), lists.word);
    }
    return false;
}

}  // namespace sonarsim
