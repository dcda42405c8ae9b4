#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/ground_map_config.h"
#include "mission/particles_config.h"
#include "mission/seabed_config.h"
#include "mission/source_location.h"
#include "mission/trajectory_keys.h"

namespace sonarsim {

enum class LengthUnit { m, mm, cm, km, inch, foot };
enum class UpAxis { y, z };

/// Options for reading a file of a mesh.
struct MeshConfig {
    LengthUnit units = LengthUnit::m;
    UpAxis up = UpAxis::y;
    std::string material;    ///< for all triangles; "": the file's materials
    Renaming materials_map;  ///< from names in the file to names in the CSV

    bool operator==(const MeshConfig&) const = default;
};

enum class ObjectPlace { free, on_bottom };

/// A file that is placed in the scene.
struct ObjectConfig {
    std::string name;        ///< name of the instance that all nodes form; "": each is its own
    std::string class_name;  ///< "": the class in the file
    std::filesystem::path file;
    MeshConfig mesh;
    std::array<double, 3> position_m{};  ///< the file's origin in the world
    std::array<double, 3> rpy_deg{};
    double scale = 1.0;
    ObjectPlace place_on = ObjectPlace::free;
    double bury_m = 0.0;  ///< burial depth of an object on the bottom
    bool align = false;   ///< upright on the bottom's slope
    std::optional<TrajectoryConfig> trajectory;
    SourceLocation place;

    bool operator==(const ObjectConfig&) const = default;
};

/// Objects placed on the bottom at random. Pairs are limits of uniform draws.
struct ScatterConfig {
    std::string name;  ///< the objects are NAME_1, NAME_2, ...
    std::string class_name;
    std::vector<std::filesystem::path> files;  ///< all equally likely
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
    SourceLocation place;

    bool operator==(const ScatterConfig&) const = default;
};

/// An image whose pixels are heights, which becomes the bottom.
struct HeightmapConfig {
    std::filesystem::path file;
    double pixel_m = 0.0;                         ///< size of a pixel; 0: by size_m, or by the file
    std::optional<std::array<double, 2>> size_m;  ///< x, y, from edge to edge of the map
    std::array<double, 2> origin_m{};             ///< point of the map that is the world's (0, 0)
    double height_scale = 1.0;                    ///< metres of a step of the pixels' values
    double height_offset_m = 0.0;
    std::string material;
    std::string class_name;
    SourceLocation place;

    bool operator==(const HeightmapConfig&) const = default;
};

/// The instance that a heightmap makes.
inline constexpr const char* heightmap_instance = "heightmap";

/// The surface of the water, which reflects sound from below.
struct WaterSurfaceConfig {
    double height_m = 0.0;
    double roughness = 0.0;  ///< share of the sound that is not reflected specularly
    bool scatters = false;   ///< scatters sound back, by the speed of the wind

    bool operator==(const WaterSurfaceConfig&) const = default;
};

struct SceneConfig {
    std::filesystem::path file;            ///< .gltf or .glb; "": objects alone make the scene
    std::filesystem::path materials;       ///< CSV
    std::string material_default = {};     ///< for surfaces without a known material; "": an error
    MeshConfig mesh = {};                  ///< options for `file`
    std::vector<std::string> bottom = {};  ///< patterns of the nodes of `file` that objects rest on
    std::optional<HeightmapConfig> heightmap = {};
    std::optional<SedimentMapConfig> sediment_map = {};
    std::optional<BackscatterMapConfig> backscatter_map = {};
    std::optional<SeabedConfig> seabed = {};
    std::vector<ObjectConfig> objects = {};
    std::vector<ScatterConfig> scatter = {};
    std::vector<ParticlesConfig> particles = {};
    std::optional<WaterSurfaceConfig> water_surface = {};
    SourceLocation place = {};

    bool operator==(const SceneConfig&) const = default;
};

}  // namespace sonarsim
