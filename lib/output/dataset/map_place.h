#pragma once

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

/// The place of a map of the bottom: in the coordinates of the scene's heightmap, if there is one,
/// else in those of the world.
inline MapPlace map_place(const WriterContext& context, const Bathymetry& map) {
    const Eigen::Vector2d origin = map_origin(context.mission);
    return {origin.x() + map.west_m, origin.y() + map.north_m, map.cell_m > 0.0 ? map.cell_m : 1.0,
            context.assembly.epsg};
}

}  // namespace sonarsim
