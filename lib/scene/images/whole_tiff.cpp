#include "scene/images/whole_tiff.h"

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/images/tiff_tags.h"

namespace sonarsim {

namespace {

constexpr std::uint16_t bits_tag = 258;
constexpr std::uint16_t strip_offsets_tag = 273;
constexpr std::uint16_t strip_bytes_tag = 279;
constexpr std::uint16_t predictor_tag = 317;
constexpr std::uint16_t tile_offsets_tag = 324;
constexpr std::uint16_t tile_bytes_tag = 325;

std::vector<double> numbers_of(const TiffTags& tags, std::uint16_t tag) {
    const auto found = tags.numbers.find(tag);
    return found == tags.numbers.end() ? std::vector<double>() : found->second;
}

double number_of(const TiffTags& tags, std::uint16_t tag) {
    const std::vector<double> values = numbers_of(tags, tag);
    return values.empty() ? 0.0 : values.front();
}

void require_pieces(const std::vector<double>& offsets, const std::vector<double>& bytes,
                    std::uintmax_t file_bytes, const Location& where) {
    if (offsets.size() != bytes.size())
        throw InputError(where,
                         "is damaged: it does not say where its pixels are; export it again");
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        if (bytes[i] == 0.0) {
            throw InputError(where,
                             "has tiles that were never written; fill them with their value "
                             "of unknown pixels, as gdal_translate does");
        }
        if (offsets[i] + bytes[i] > static_cast<double>(file_bytes))
            throw InputError(where, "ends before its pixels do: it was cut off; copy it again");
    }
}

}  // namespace

void require_whole_tiff(const std::filesystem::path& path) {
    constexpr double of_floats = 3.0;
    const Location where{path.string()};
    const TiffTags tags = read_tiff_tags(path, {bits_tag, strip_offsets_tag, strip_bytes_tag,
                                                predictor_tag, tile_offsets_tag, tile_bytes_tag});
    const std::uintmax_t file_bytes = std::filesystem::file_size(path);
    const std::vector<double> tiles = numbers_of(tags, tile_offsets_tag);
    if (!tiles.empty() && number_of(tags, bits_tag) > 32.0) {
        throw InputError(where,
                         "has tiles of 64-bit numbers, which are not read; make it narrower "
                         "with gdal_translate -ot Float32");
    }
    if (tags.is_big_endian && number_of(tags, predictor_tag) == of_floats) {
        throw InputError(where,
                         "is big-endian with the predictor of floats, which is not read; "
                         "write it anew with gdal_translate");
    }
    require_pieces(tiles, numbers_of(tags, tile_bytes_tag), file_bytes, where);
    require_pieces(numbers_of(tags, strip_offsets_tag), numbers_of(tags, strip_bytes_tag),
                   file_bytes, where);
}

}  // namespace sonarsim
