#pragma once

#include <algorithm>

#include "core/file.h"
#include "output/dataset/json.h"
#include "output/dataset/writer.h"
#include "output/format/geotiff.h"
#include "simulate/product/bathymetry.h"

namespace sonarsim {

/// The world's (0, 0) in the coordinates of the scene's heightmap; (0, 0) without one.
inline Eigen::Vector2d map_origin(const Mission& mission) {
    const auto& heightmap = mission.scene.heightmap;
    return heightmap ? Eigen::Vector2d(heightmap->origin_m[0], heightmap->origin_m[1])
                     : Eigen::Vector2d(0.0, 0.0);
}

/// Writes a map of the bottom: NAME.tif with its values, and NAME.json with the keys of `head`, the
/// place (in the coordinates of the scene's heightmap, else of the world) and the keys of `tail`.
inline void write_map(const WriterContext& context, const std::filesystem::path& folder,
                      const std::string& name, const GroundGrid& map, std::vector<float> values,
                      Json head, const Json& tail) {
    // A TIFF has at least one pixel; where no ping shows the bottom it is NaN.
    if (values.empty()) values.push_back(std::nanf(""));
    const Eigen::Vector2d origin = map_origin(context.mission);
    const MapPlace place{origin.x() + map.west_m, origin.y() + map.north_m,
                         map.cell_m > 0.0 ? map.cell_m : 1.0, context.assembly.epsg};
    write_file(folder / (name + ".tif"), geotiff_bytes(values, std::max(map.columns, 1), place));
    head.update({{"rows", map.rows},
                 {"columns", map.columns},
                 {"cell_m", map.cell_m},
                 {"west_m", place.west_m},
                 {"north_m", place.north_m},
                 {"epsg", place.epsg}});
    head.update(tail);
    write_file(folder / (name + ".json"), json_text(head));
}

}  // namespace sonarsim
