#include "scene/heightmap/height_patch.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>

namespace sonarsim {

std::size_t heights_in(const tinygltf::Model& model) {
    return model.accessors.front().count;  // the positions
}

HeightPatches::HeightPatches(const PlacedFile& map, int side, ImageReader& images)
    : field_(read_heights(map.file, *map.heightmap, images)),
      T_world_file_(map.T_world_file),
      side_(side),
      has_unknown_(std::ranges::find(field_.known, false) != field_.known.end()) {
    const PixelWindow& window = field_.window;
    for (int row = window.first_row; row + 1 < window.last_row; row += side) {
        for (int column = window.first_column; column + 1 < window.last_column; column += side) {
            Eigen::AlignedBox3d box;
            for (int r = row; r <= std::min(row + side, window.last_row - 1); ++r) {
                for (int c = column; c <= std::min(column + side, window.last_column - 1); ++c)
                    box.extend(world(r, c));
            }
            Patch& patch = patches_.emplace_back();
            patch.row = row;
            patch.column = column;
            patch.centre = box.center();
            patch.radius_m = 0.5 * box.diagonal().norm();
        }
    }
}

Eigen::Vector3d HeightPatches::world(int row, int column) const {
    return T_world_file_ *
           Eigen::Vector3d(field_.grid.x_m + column * field_.grid.column_m,
                           field_.grid.y_m + row * field_.grid.row_m,
                           static_cast<double>(field_.heights[field_.index(row, column)]));
}

std::vector<std::size_t> HeightPatches::where(
    const std::function<bool(const Eigen::Vector3d&, double)>& is_needed) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        if (is_needed(patches_[i].centre, patches_[i].radius_m)) out.push_back(i);
    }
    return out;
}

Scene HeightPatches::scene(const std::vector<std::size_t>& patches, int every,
                           const Eigen::Vector3d& origin) const {
    Scene out;
    out.origin = origin;
    out.instances = {"heightmap"};
    out.materials.resize(1);
    out.materials.front().reflection = 1.0F;
    const PixelWindow& window = field_.window;
    for (const std::size_t i : patches) {
        const int last_row = std::min(patches_[i].row + side_ + 1, window.last_row);
        const int last_column = std::min(patches_[i].column + side_ + 1, window.last_column);
        const std::vector<int> rows = every_of(patches_[i].row, last_row, every);
        const std::vector<int> columns = every_of(patches_[i].column, last_column, every);
        const auto first = static_cast<std::uint32_t>(out.vertices.size());
        for (const int row : rows) {
            for (const int column : columns)
                out.vertices.push_back((world(row, column) - origin).cast<float>());
        }
        const auto width = static_cast<std::uint32_t>(columns.size());
        for (std::uint32_t r = 0; r + 1 < rows.size(); ++r) {
            for (std::uint32_t c = 0; c + 1 < width; ++c) {
                const std::uint32_t north_west = first + r * width + c;
                const std::uint32_t south_west = north_west + width;
                out.triangles.push_back({north_west, south_west, south_west + 1});
                out.triangles.push_back({north_west, south_west + 1, north_west + 1});
            }
        }
    }
    out.triangle_material.assign(out.triangles.size(), 0);
    out.triangle_instance.assign(out.triangles.size(), 0);
    return out;
}

}  // namespace sonarsim
