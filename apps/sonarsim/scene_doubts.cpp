#include "scene_doubts.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cstdint>

#include "scene/materials.h"

namespace sonarsim {

std::vector<std::string> doubts_about(const Scene& scene) {
    std::vector<std::string> doubts;
    const SceneRejects& rejects = scene.rejects;
    const auto left_out = [&](std::uint64_t count, const char* what) {
        if (count > 0)
            doubts.push_back(fmt::format("the scene has {} {}; they are left out", count, what));
    };
    left_out(rejects.degenerate_triangles, "triangles without area");
    left_out(rejects.non_finite_triangles, "triangles with a vertex that is NaN or infinite");
    left_out(rejects.skipped_primitives, "primitives of points or lines");
    doubts.insert(doubts.end(), scene.warnings.begin(), scene.warnings.end());
    for (std::string& doubt : unit_warnings(scene.materials))
        doubts.push_back(std::move(doubt));
    if (has_coarse_vertices(scene)) {
        doubts.push_back(fmt::format(
            "the scene's vertices may be off by {:.2g} m: its file holds large coordinates as "
            "floats; put them into the translation of a node instead",
            scene.vertex_rounding_m));
    }
    return doubts;
}

std::size_t warn_about(const Scene& scene) {
    const std::vector<std::string> doubts = doubts_about(scene);
    for (const std::string& doubt : doubts)
        spdlog::warn("{}", doubt);
    return doubts.size();
}

}  // namespace sonarsim
