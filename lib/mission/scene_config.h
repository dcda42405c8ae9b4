#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/place.h"
#include "mission/trajectory_config.h"

namespace sonarsim {

enum class LengthUnit { m, mm, cm, km, inch, foot };
enum class UpAxis { y, z };

/// Names and what they are replaced by, in the order of the file.
using Renaming = std::vector<std::pair<std::string, std::string>>;

/// How a glTF file is read.
struct MeshConfig {
    LengthUnit units = LengthUnit::m;
    UpAxis up = UpAxis::y;
    std::string material;              ///< of every triangle; "": the file's own
    Renaming materials_map;            ///< from the names of the file to those of the CSV
    std::vector<std::string> exclude;  ///< patterns of nodes that are left out

    bool operator==(const MeshConfig&) const = default;
};

enum class ObjectPlace { free, on_bottom };

/// A file that is put somewhere in the scene.
struct ObjectConfig {
    std::string name;        ///< makes one instance of all nodes; "": each is its own
    std::string class_name;  ///< "": as the file says
    std::filesystem::path file;
    MeshConfig mesh;
    std::array<double, 3> position_m{};  ///< of the file's origin in the world
    std::array<double, 3> rpy_deg{};
    double scale = 1.0;
    ObjectPlace place_on = ObjectPlace::free;
    double bury_m = 0.0;  ///< how deep an object on the bottom sinks into it
    bool align = false;   ///< an object on the bottom stands upright on its slope
    std::optional<TrajectoryConfig> trajectory;
    Place place;

    bool operator==(const ObjectConfig&) const = default;
};

/// Objects that are strewn over the bottom. Pairs are ranges that are drawn from uniformly.
struct ScatterConfig {
    std::string name;  ///< objects are NAME_1, NAME_2, ...
    std::string class_name;
    std::vector<std::filesystem::path> files;  ///< each as likely as another
    MeshConfig mesh;
    std::array<double, 2> count{1, 1};
    std::array<double, 2> area_min_m{};  ///< x, y
    std::array<double, 2> area_max_m{};
    std::array<double, 2> roll_deg{};
    std::array<double, 2> pitch_deg{};
    std::array<double, 2> yaw_deg{0, 360};
    std::array<double, 2> scale{1, 1};
    std::array<double, 2> bury_m{};
    double spacing_m = 0.0;  ///< least distance between objects, seen from above
    bool align = false;
    int tries = 1000;  ///< places that are tried for each object
    Place place;

    bool operator==(const ScatterConfig&) const = default;
};

/// What becomes of a file that is put into the scene many times.
enum class RepeatedFiles { automatic, copied, shared };

/// The surface of the water, a mirror for sound from below.
struct WaterSurfaceConfig {
    double height_m = 0.0;
    double roughness = 0.0;  ///< share of the sound that it scatters away

    bool operator==(const WaterSurfaceConfig&) const = default;
};

struct SceneConfig {
    std::filesystem::path file;            ///< .gltf or .glb; "": objects alone make the scene
    std::filesystem::path materials;       ///< CSV
    std::string material_default = {};     ///< for what the CSV lacks or has no name; "": an error
    MeshConfig mesh = {};                  ///< of `file`
    std::vector<std::string> bottom = {};  ///< patterns of nodes of `file` that objects rest on
    std::vector<ObjectConfig> objects = {};
    std::vector<ScatterConfig> scatter = {};
    RepeatedFiles repeats = RepeatedFiles::automatic;
    std::optional<WaterSurfaceConfig> water_surface = {};
    Place place = {};

    bool operator==(const SceneConfig&) const = default;
};

}  // namespace sonarsim
