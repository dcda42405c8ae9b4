#include <spdlog/fmt/fmt.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "logging.h"
#include "scene/gltf/load.h"
#include "scene/summary.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

struct InspectArguments {
    std::filesystem::path scene;
    LogOptions log;
};

Json vector_json(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

/// `names`, each with the number of triangles whose index in `owners` points at it.
Json shares_json(const std::vector<std::string>& names, const std::vector<std::uint32_t>& owners) {
    std::vector<std::uint64_t> triangles(names.size());
    for (const std::uint32_t owner : owners)
        ++triangles[owner];
    Json json = Json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
        json.push_back({{"name", names[i]}, {"triangles", triangles[i]}});
    }
    return json;
}

Json scene_json(const Scene& scene) {
    std::vector<std::string> materials;
    for (const Material& material : scene.materials)
        materials.push_back(material.name);
    return {{"bounds_min_m", vector_json(scene.bounds_min)},
            {"bounds_max_m", vector_json(scene.bounds_max)},
            {"origin_m", vector_json(scene.origin)},
            {"triangles", scene.triangles.size()},
            {"vertices", scene.vertices.size()},
            {"degenerate_triangles", scene.rejects.degenerate_triangles},
            {"non_finite_triangles", scene.rejects.non_finite_triangles},
            {"skipped_primitives", scene.rejects.skipped_primitives},
            {"vertex_rounding_m", scene.vertex_rounding_m},
            {"materials", shares_json(materials, scene.triangle_material)},
            {"instances", shares_json(scene.instances, scene.triangle_instance)}};
}

int inspect(const InspectArguments& arguments) {
    start_logging(arguments.log);
    const Scene scene = load_scene_geometry(arguments.scene);
    warn_about(scene);
    fmt::print("{}", arguments.log.json ? json_line(scene_json(scene)) : describe_scene(scene));
    return exit_done;
}

}  // namespace

void add_inspect(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "inspect", "Prints bounds, triangles, materials and instances of a scene");
    auto arguments = std::make_shared<InspectArguments>();
    command.add_option("scene", arguments->scene, "The scene, a .gltf or .glb file")->required();
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = inspect(*arguments); });
}

}  // namespace sonarsim
