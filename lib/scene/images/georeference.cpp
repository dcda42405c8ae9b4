#include "scene/images/georeference.h"

#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/images/tiff_tags.h"
#include "scene/images/world_file.h"

namespace sonarsim {

namespace {

constexpr std::uint16_t pixel_scale_tag = 33550;
constexpr std::uint16_t tie_point_tag = 33922;
constexpr std::uint16_t transformation_tag = 34264;
constexpr std::uint16_t key_directory_tag = 34735;
constexpr std::uint16_t no_data_tag = 42113;

/// A key of GeoTIFF whose value is a short; 0 if the file lacks it.
int geo_key(const TiffTags& tags, int key) {
    const auto found = tags.numbers.find(key_directory_tag);
    if (found == tags.numbers.end()) return 0;
    const std::vector<double>& words = found->second;
    // A header of four numbers, then for each key its number, the tag of its value (0: this one), a
    // count and the value.
    for (std::size_t i = 4; i + 3 < words.size(); i += 4) {
        if (words[i] == key && words[i + 1] == 0.0) return static_cast<int>(words[i + 3]);
    }
    return 0;
}

/// The length of the unit of the map's coordinates, m.
double metres_of_unit(const TiffTags& tags, const Location& where) {
    constexpr int linear_units = 3076;  // ProjLinearUnitsGeoKey
    switch (geo_key(tags, linear_units)) {
        case 0:
        case 9001:
            return 1.0;
        case 9002:
            return 0.3048;
        case 9003:
            return 1200.0 / 3937.0;
        default:
            throw InputError(where,
                             "its coordinates are neither in metres nor in feet; make a "
                             "map in metres of it, as with gdalwarp -t_srs EPSG:32632");
    }
}

/// Moves the grid's first point from the outer corner of its pixel to the centre, if
/// `point_at_corner`.
PixelGrid centred(PixelGrid grid, bool point_at_corner) {
    if (point_at_corner) {
        grid.x_m += 0.5 * grid.column_m;
        grid.y_m += 0.5 * grid.row_m;
    }
    return grid;
}

/// The grid that the tags give, in the map's own unit.
std::optional<PixelGrid> grid_of_tags(const TiffTags& tags, const Location& where) {
    constexpr int raster_type = 1025;  // GTRasterTypeGeoKey
    constexpr int pixel_is_point = 2;
    const bool at_corner = geo_key(tags, raster_type) != pixel_is_point;
    const auto matrix = tags.numbers.find(transformation_tag);
    if (matrix != tags.numbers.end() && matrix->second.size() == 16) {
        const std::vector<double>& m = matrix->second;
        if (m[1] != 0.0 || m[4] != 0.0) refuse_turned_grid(where);
        return centred({m[3], m[7], m[0], m[5]}, at_corner);
    }
    const auto scale = tags.numbers.find(pixel_scale_tag);
    const auto tie = tags.numbers.find(tie_point_tag);
    if (scale == tags.numbers.end() || tie == tags.numbers.end()) return std::nullopt;
    if (scale->second.size() < 2 || tie->second.size() != 6) {
        throw InputError(where,
                         "its GeoTIFF tags do not give one tie point and a pixel size; make "
                         "a plain map of it, as with gdalwarp");
    }
    const std::vector<double>& t = tie->second;
    PixelGrid grid{0.0, 0.0, scale->second[0], -scale->second[1]};
    grid.x_m = t[3] - t[0] * grid.column_m;
    grid.y_m = t[4] - t[1] * grid.row_m;
    return centred(grid, at_corner);
}

Georeference reference_of_tiff(const std::filesystem::path& image) {
    constexpr int model_type = 1024;  // GTModelTypeGeoKey
    constexpr int geographic = 2;
    const Location where{image.string()};
    const TiffTags tags = read_tiff_tags(image, {pixel_scale_tag, tie_point_tag, transformation_tag,
                                                 key_directory_tag, no_data_tag});
    Georeference out;
    out.grid = grid_of_tags(tags, where);
    out.in_degrees = geo_key(tags, model_type) == geographic;
    if (out.grid && !out.in_degrees) {
        const double unit_m = metres_of_unit(tags, where);
        out.grid->x_m *= unit_m;
        out.grid->y_m *= unit_m;
        out.grid->column_m *= unit_m;
        out.grid->row_m *= unit_m;
    }
    const auto text = tags.texts.find(no_data_tag);
    if (text != tags.texts.end()) {
        out.no_data = parse_number(trim(text->second));
        if (!out.no_data) {
            throw InputError(where, "has the mark of unknown pixels '" + text->second +
                                        "' (GDAL_NODATA), which is no number; set it anew, as "
                                        "with gdal_translate -a_nodata -9999");
        }
    } else if (has_tiff_mask(image)) {
        throw InputError(where,
                         "marks unknown pixels by a mask, which is not read; mark them by a value, "
                         "as with gdalwarp -dstnodata -9999");
    }
    return out;
}

}  // namespace

Georeference read_georeference(const std::filesystem::path& image) {
    Georeference out;
    if (is_tiff(image)) out = reference_of_tiff(image);
    if (!out.grid) out.grid = read_world_file(image);
    if (out.grid) {
        const PixelGrid& grid = *out.grid;
        const bool holds = std::isfinite(grid.x_m) && std::isfinite(grid.y_m) &&
                           std::isfinite(grid.column_m) && std::isfinite(grid.row_m) &&
                           grid.column_m != 0.0 && grid.row_m != 0.0;
        if (!holds) {
            throw InputError(Location{image.string()},
                             "its pixel size or its place is no number or 0; export it again");
        }
    }
    return out;
}

}  // namespace sonarsim
