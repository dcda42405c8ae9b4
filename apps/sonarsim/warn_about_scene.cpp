#include "warn_about_scene.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cstdint>

#include "scene/materials.h"

namespace sonarsim {

std::vector<std::string> warnings_about(const Scene& scene) {
    std::vector<std::string> warnings;
    const SceneRejects& rejects = scene.rejects;
    const auto left_out = [&](std::uint64_t count, const char* what) {
        if (count > 0)
            warnings.push_back(fmt::format("the scene has {} {}; they are left out", count, what));
    };
    left_out(rejects.degenerate_triangles, "triangles without area");
    left_out(rejects.non_finite_triangles, "triangles with a vertex that is NaN or infinite");
    left_out(rejects.skipped_primitives, "primitives of points or lines");
    warnings.insert(warnings.end(), scene.warnings.begin(), scene.warnings.end());
    for (std::string& warning : unit_warnings(scene.materials))
        warnings.push_back(std::move(warning));
    if (has_coarse_vertices(scene)) {
        warnings.push_back(fmt::format(
            "the scene's vertices may be off by {:.2g} m: its file holds large coordinates as "
            "floats; put them into the translation of a node instead",
            scene.vertex_rounding_m));
    }
    return warnings;
}

std::size_t warn_about(const Scene& scene) {
    const std::vector<std::string> warnings = warnings_about(scene);
    for (const std::string& warning : warnings)
        spdlog::warn("{}", warning);
    return warnings.size();
}

}  // namespace sonarsim
