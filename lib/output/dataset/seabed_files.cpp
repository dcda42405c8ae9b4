#include "output/dataset/seabed_files.h"

#include <spdlog/fmt/fmt.h>

#include "output/dataset/json.h"
#include "output/format/geotiff.h"
#include "output/format/png.h"

namespace sonarsim {

namespace {

/// World z of the cells: a GeoTIFF in the mission's x and y, which scene.heightmap reads.
constexpr const char* seabed_heights_name = "seabed/heights.tif";
/// The index of the material of each cell, a grey PNG of 8 bits, and its world file.
constexpr const char* seabed_materials_name = "seabed/materials.png";
constexpr const char* seabed_place_name = "seabed/materials.pgw";
/// The place of these maps, the materials, and all rocks.
constexpr const char* seabed_list_name = "seabed/seabed.json";

Json list_materials(const Seabed& bed) {
    std::vector<std::size_t> counts(bed.materials.size(), 0);
    for (const std::uint8_t sediment : bed.sediments.cells)
        ++counts[sediment];
    Json out = Json::array();
    for (std::size_t i = 0; i < bed.materials.size(); ++i) {
        out.push_back({{"value", i},
                       {"material", bed.materials[i]},
                       {"share", static_cast<double>(counts[i]) /
                                     static_cast<double>(bed.sediments.cells.size())}});
    }
    return out;
}

Json list_rocks(const Seabed& bed) {
    Json out = Json::array();
    for (std::size_t i = 0; i < bed.rocks.size(); ++i) {
        const Rock& rock = bed.rocks[i];
        const Eigen::AlignedBox3d box =
            box_of(moved(bed.rock_shapes[rock.shape], rock.T_world_shape));
        out.push_back({{"name", rock_name(i)},
                       {"diameter_m", rock.diameter_m},
                       {"buried", rock.buried},
                       {"middle_m", describe_vector(rock.T_world_shape.translation())},
                       {"box_world_m", describe_box(box)}});
    }
    return out;
}

}  // namespace

std::vector<std::string> seabed_file_names() {
    return {seabed_heights_name, seabed_materials_name, seabed_place_name, seabed_list_name};
}

std::vector<std::pair<std::string, std::string>> seabed_files(const Seabed& bed) {
    const BedGrid& grid = bed.grid;
    const MapPlace place{.west_m = grid.x_m(0) - 0.5 * grid.cell_m,
                         .north_m = grid.y_m(0) + 0.5 * grid.cell_m,
                         .cell_m = grid.cell_m};
    const Json list{{"grid",
                     {{"west_m", place.west_m},
                      {"north_m", place.north_m},
                      {"cell_m", place.cell_m},
                      {"rows", grid.rows},
                      {"columns", grid.columns}}},
                    {"materials", list_materials(bed)},
                    {"rocks", list_rocks(bed)}};
    const std::string world_file =
        fmt::format("{}\n0\n0\n{}\n{}\n{}\n", grid.cell_m, -grid.cell_m, grid.x_m(0), grid.y_m(0));
    return {{seabed_heights_name, geotiff_bytes(bed.heights, grid.columns, place)},
            {seabed_materials_name, png_bytes(bed.sediments.cells, grid.columns, grid.rows)},
            {seabed_place_name, world_file},
            {seabed_list_name, json_text(list)}};
}

}  // namespace sonarsim
