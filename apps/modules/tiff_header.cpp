#include "tiff_header.h"

#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

namespace {

struct Closer {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

/// The values of a tag that libtiff does not know, as the file has them.
template <class T>
struct Values {
    const T* data = nullptr;
    std::uint32_t count = 0;
};

/// Values of another type than `type` are left out: libtiff would hand over its own bytes of them.
template <class T>
Values<T> values_of(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
    Values<T> out;
    const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0 ||
        TIFFFieldReadCount(field) != TIFF_VARIABLE2)
        return out;
    void* data = nullptr;
    if (TIFFGetField(tiff, tag, &out.count, &data) == 1) out.data = static_cast<const T*>(data);
    if (out.data == nullptr) out.count = 0;
    return out;
}

std::uint16_t short_of(TIFF* tiff, std::uint32_t tag) {
    std::uint16_t value = 0;
    TIFFGetFieldDefaulted(tiff, tag, &value);
    return value;
}

/// Strips or tiles beyond the end of the file, or without bytes, would be read as zeros.
void require_pieces(TIFF* tiff) {
    const bool has_tiles = TIFFIsTiled(tiff) != 0;
    const std::uint32_t count = has_tiles ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    const std::uint64_t file_bytes = TIFFGetSizeProc(tiff)(TIFFClientdata(tiff));
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t offset = TIFFGetStrileOffset(tiff, i);
        const std::uint64_t bytes = TIFFGetStrileByteCount(tiff, i);
        if (bytes == 0) {
            throw std::runtime_error(
                "it has empty tiles or strips; fill them with the no-data value, as "
                "gdal_translate does");
        }
        if (offset > file_bytes || bytes > file_bytes - offset)
            throw std::runtime_error("it ends before its pixels do: it was cut off; copy it again");
    }
}

void require_numbers(TIFF* tiff) {
    const unsigned bits = short_of(tiff, TIFFTAG_BITSPERSAMPLE);
    if (bits != 8 && bits != 16 && bits != 32 && bits != 64) {
        throw std::runtime_error("its numbers have " + std::to_string(bits) +
                                 " bits; write it with gdal_translate -ot Float32");
    }
    std::uint16_t colours = PHOTOMETRIC_MINISBLACK;
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &colours);
    if (colours == PHOTOMETRIC_PALETTE)
        throw std::runtime_error(
            "it has a palette; write its colours with gdal_translate -expand rgb");
    if (colours != PHOTOMETRIC_MINISBLACK && colours != PHOTOMETRIC_RGB) {
        throw std::runtime_error(
            "its numbers are neither plain nor red, green and blue (PhotometricInterpretation " +
            std::to_string(colours) + "), and would not stay exact; export it as PNG");
    }
    if (TIFFIsTiled(tiff) != 0 && bits == 64)
        throw std::runtime_error(
            "it has tiles of 64-bit numbers; write it with gdal_translate -ot Float32");
    if (TIFFIsBigEndian(tiff) != 0 && short_of(tiff, TIFFTAG_PREDICTOR) == PREDICTOR_FLOATINGPOINT)
        throw std::runtime_error(
            "it is big-endian with the predictor of floats; write it with gdal_translate");
}

/// A key of GeoTIFF whose value is a short; 0 if the file lacks it.
int geo_key(const Values<std::uint16_t>& words, int key) {
    // Four numbers; then for each key its number, the tag of its value (0: this), count and value.
    for (std::uint32_t i = 4; i + 3 < words.count; i += 4) {
        if (words.data[i] == key && words.data[i + 1] == 0) return words.data[i + 3];
    }
    return 0;
}

/// True if this EPSG code lies in ranges of projected systems in metres alone (registry of 2022).
bool is_metric(int epsg) {
    constexpr int ranges[][2] = {
        {2000, 2065},   {2067, 2135},   {2137, 2154},   {2161, 2193},   {2315, 2866},
        {2955, 2962},   {2969, 2989},   {2995, 3079},   {3168, 3358},   {3366, 3403},
        {3408, 3416},   {3571, 3581},   {3761, 3989},   {3993, 4096},   {4462, 5469},
        {5479, 5583},   {5659, 6125},   {6204, 6387},   {6634, 6784},   {6931, 6962},
        {7374, 7586},   {7692, 8032},   {8677, 9741},   {9761, 20049},  {20064, 22293},
        {22307, 24048}, {24600, 26722}, {26891, 27260}, {27391, 29333}, {30339, 32000},
        {32100, 32161}, {32180, 32663}, {32668, 32766}};
    return std::ranges::any_of(
        ranges, [&](const auto& range) { return epsg >= range[0] && epsg <= range[1]; });
}

constexpr int linear_units = 3076;  // ProjLinearUnitsGeoKey

/// The length of the unit of the map's coordinates, m.
double metres_of_unit(const Values<std::uint16_t>& keys) {
    switch (geo_key(keys, linear_units)) {
        case 0:
        case 9001:
            return 1.0;
        case 9002:
            return 0.3048;
        case 9003:
            return 1200.0 / 3937.0;
        default:
            throw std::runtime_error(
                "its coordinates are neither in metres nor in feet; make a map in metres of it, "
                "as with gdalwarp -t_srs EPSG:32632");
    }
}

/// True by VerticalUnitsGeoKey, or by the VerticalGeoKey of MSL, NAVD88 or NGVD29 in feet.
bool has_heights_in_feet(const Values<std::uint16_t>& keys) {
    const int unit = geo_key(keys, 4099);
    const int system = geo_key(keys, 4096);
    constexpr int in_feet[] = {5702, 6358, 6359, 6360, 8050, 8051, 8052, 8053, 8228};
    return unit == 9002 || unit == 9003 || std::ranges::find(in_feet, system) != std::end(in_feet);
}

void read_grid(TIFF* tiff, SonarsimImageHead& head) {
    constexpr int model_type = 1024;   // GTModelTypeGeoKey
    constexpr int geographic = 2;      // longitudes and latitudes
    constexpr int raster_type = 1025;  // GTRasterTypeGeoKey
    constexpr int pixel_is_point = 2;
    constexpr int projected_system = 3072;  // ProjectedCRSGeoKey
    constexpr int user_defined = 32767;
    const auto scale = values_of<double>(tiff, 33550, TIFF_DOUBLE);
    const auto tie = values_of<double>(tiff, 33922, TIFF_DOUBLE);
    const auto matrix = values_of<double>(tiff, 34264, TIFF_DOUBLE);
    const auto keys = values_of<std::uint16_t>(tiff, 34735, TIFF_SHORT);
    if (scale.count == 0 && tie.count == 0 && matrix.count == 0) return;
    if (scale.count < 2 || tie.count != 6) {
        throw std::runtime_error(
            "its GeoTIFF tags do not give one tie point and a pixel size; make a plain map of it, "
            "as with gdalwarp");
    }
    head.has_grid = 1;
    const int system = geo_key(keys, projected_system);
    if (system == 3395 || system == 3785 || system == 3857) {
        throw std::runtime_error(
            "the metres of its system, a Mercator map of the world, are longer than those of the "
            "ground; make a map in metres of it, as with gdalwarp -t_srs EPSG:32632");
    }
    const bool in_degrees = geo_key(keys, model_type) == geographic;
    const double unit_m = in_degrees ? 1.0 : metres_of_unit(keys);
    const bool has_unit = geo_key(keys, linear_units) != 0 || system == 0 || is_metric(system);
    head.heights_in_feet = has_heights_in_feet(keys) ? 1 : 0;
    head.unit = in_degrees ? 1 : has_unit ? 0 : 2;
    // Products have metres, which a system in feet would misplace.
    if (system != user_defined && unit_m == 1.0) head.epsg = static_cast<std::uint32_t>(system);
    const double column = scale.data[0];
    const double row = -scale.data[1];
    // The tie point belongs to the outer corner of its pixel, or to its centre.
    const double to_centre = geo_key(keys, raster_type) == pixel_is_point ? 0.0 : 0.5;
    head.grid[0] = unit_m * (tie.data[3] - tie.data[0] * column + to_centre * column);
    head.grid[1] = unit_m * (tie.data[4] - tie.data[1] * row + to_centre * row);
    head.grid[2] = unit_m * column;
    head.grid[3] = unit_m * row;
}

void require_plain_values(TIFF* tiff) {
    const auto text = values_of<char>(tiff, 42112, TIFF_ASCII);
    const std::string items(text.data, text.data + text.count);
    if (items.find("role=\"scale\"") == std::string::npos &&
        items.find("role=\"offset\"") == std::string::npos)
        return;
    throw std::runtime_error(
        "its values have a scale or an offset; apply it: gdal_translate -unscale -ot Float32");
}

void read_no_data(TIFF* tiff, SonarsimImageHead& head) {
    const auto text = values_of<char>(tiff, 42113, TIFF_ASCII);
    const std::size_t size = std::min<std::size_t>(text.count, sizeof(head.no_data) - 1);
    if (size > 0) std::memcpy(head.no_data, text.data, size);
    if (size > 0) return;
    // A mask is a further image. GDAL writes one where pixels are unknown.
    constexpr int max_images = 64;
    for (int image = 0; image < max_images && TIFFReadDirectory(tiff) == 1; ++image) {
        std::uint32_t kind = 0;
        if (TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind) == 1 && (kind & FILETYPE_MASK) != 0) {
            throw std::runtime_error(
                "it marks unknown pixels by a mask, which is not read; mark them by a value, as "
                "with gdalwarp -dstnodata -9999");
        }
    }
}

}  // namespace

void read_tiff_header(const char* file, SonarsimImageHead& head) {
    // OpenImageIO sets handlers of its own. Errors are returned; warnings are about unused tags.
    const TIFFErrorHandler errors = TIFFSetErrorHandler(nullptr);
    const TIFFErrorHandler warnings = TIFFSetWarningHandler(nullptr);
    const std::unique_ptr<TIFF, Closer> tiff(TIFFOpen(file, "r"));
    TIFFSetErrorHandler(errors);
    TIFFSetWarningHandler(warnings);
    if (!tiff) throw std::runtime_error("its header is damaged: copy or export it again");
    require_numbers(tiff.get());
    require_pieces(tiff.get());
    require_plain_values(tiff.get());
    read_grid(tiff.get(), head);
    read_no_data(tiff.get(), head);
}
