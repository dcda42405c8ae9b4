#include "output/format/geotiff.h"

#include <bit>
#include <cstdint>
#include <string_view>

namespace sonarsim {

namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they are in memory");

/// The types of a tag's values, numbered as in TIFF 6.0.
enum class TagType : std::uint16_t { ascii = 2, u16 = 3, u32 = 4, f64 = 12 };

/// The bytes of a number or of an array of numbers.
template <class T>
std::string bytes_of(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// The header of a TIFF, tags ascending. Values beyond a tag's 12 bytes follow the last tag.
class TiffHeader {
  public:
    explicit TiffHeader(std::uint16_t tags)
        : values_at_(start.size() + 2 + 12 * std::size_t{tags} + no_more.size()),
          tags_(std::string(start) + bytes_of(tags)) {}

    void add(std::uint16_t tag, TagType type, std::uint32_t count, std::string bytes) {
        tags_ += bytes_of(tag) + bytes_of(type) + bytes_of(count);
        if (bytes.size() > 4) {
            const auto at = static_cast<std::uint32_t>(values_at_ + values_.size());
            values_ += bytes;
            bytes = bytes_of(at);
        }
        bytes.resize(4, '\0');
        tags_ += bytes;
    }
    void add(std::uint16_t tag, std::uint16_t value) { add(tag, TagType::u16, 1, bytes_of(value)); }
    void add(std::uint16_t tag, std::uint32_t value) { add(tag, TagType::u32, 1, bytes_of(value)); }

    std::string bytes() const { return tags_ + std::string(no_more) + values_; }

  private:
    /// Little-endian, and the list of tags begins at byte 8.
    static constexpr std::string_view start{"II*\0\x08\0\0\0", 8};
    /// Offset 0: there is no second list of tags.
    static constexpr std::string_view no_more{"\0\0\0\0", 4};

    std::size_t values_at_;
    std::string tags_;
    std::string values_;
};

void add_place(const MapPlace& place, TiffHeader& out) {
    const double pixel_scale[] = {place.cell_m, place.cell_m, 0.0};
    // Raster (0, 0), the outer corner of the first cell, lies at the world's (west, north).
    const double tie_point[] = {0.0, 0.0, 0.0, place.west_m, place.north_m, 0.0};
    out.add(33550, TagType::f64, 3, bytes_of(pixel_scale));  // ModelPixelScaleTag
    out.add(33922, TagType::f64, 6, bytes_of(tie_point));    // ModelTiepointTag
    if (place.epsg != 0) {
        // GeoKeyDirectoryTag: a projected model, whose pixels are areas. A header with the number
        // of keys, then for each its number, 0, one value, the value.
        const auto epsg = static_cast<std::uint16_t>(place.epsg);
        const std::uint16_t keys[] = {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, epsg};
        out.add(34735, TagType::u16, std::size(keys), bytes_of(keys));
    }
    out.add(42113, TagType::ascii, 4, bytes_of("nan"));  // GDAL_NODATA
}

/// The header of a map whose cells begin at byte `pixels_at`.
std::string header(std::uint32_t columns, std::uint32_t rows, const MapPlace& place,
                   std::uint32_t pixels_at) {
    constexpr std::uint16_t tags_of_map = 13;
    constexpr std::uint16_t one = 1;
    TiffHeader out(place.epsg != 0 ? tags_of_map + 1 : tags_of_map);
    out.add(256, columns);             // ImageWidth
    out.add(257, rows);                // ImageLength
    out.add(258, std::uint16_t{32});   // BitsPerSample
    out.add(259, one);                 // Compression: none
    out.add(262, one);                 // greater is brighter
    out.add(273, pixels_at);           // StripOffsets
    out.add(277, one);                 // SamplesPerPixel
    out.add(278, rows);                // RowsPerStrip: one strip
    out.add(279, 4 * columns * rows);  // StripByteCounts
    out.add(339, std::uint16_t{3});    // SampleFormat: floating point
    add_place(place, out);
    return out.bytes();
}

}  // namespace

std::string geotiff_bytes(std::span<const float> values, int columns, const MapPlace& place) {
    const auto width = static_cast<std::uint32_t>(columns);
    const auto height = static_cast<std::uint32_t>(values.size() / width);
    const auto size = static_cast<std::uint32_t>(header(width, height, place, 0).size());
    std::string out = header(width, height, place, size);
    out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return out;
}

}  // namespace sonarsim
