#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"
#include "input/mission/particle_keys.h"
#include "input/mission/seabed_keys.h"
#include "input/mission/trajectory_keys.h"
#include "input/mission/water_keys.h"

// The keys of the scene, with their defaults and their descriptions as in mission.h.

namespace sonarsim {

enum class LengthUnit { m, mm, cm, km, inch, foot };

struct LengthUnitRow {
    double metres;
    const char* plural;
};

/// Indexed by LengthUnit.
inline constexpr LengthUnitRow length_unit_rows[] = {{1.0, "metres"},       {1e-3, "millimetres"},
                                                     {1e-2, "centimetres"}, {1e3, "kilometres"},
                                                     {0.0254, "inches"},    {0.3048, "feet"}};

/// The length of a unit, m.
constexpr double metres(LengthUnit unit) {
    return length_unit_rows[static_cast<std::size_t>(unit)].metres;
}

enum class UpAxis : std::uint8_t { y, z };

/// Options for reading a file of a mesh.
struct MeshConfig {
    LengthUnit units = LengthUnit::m;
    UpAxis up = UpAxis::y;
    bool up_given = false;  ///< the mission has the key `up`
    std::string material;   ///< for all triangles; "": the file's materials

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
    Location place = {};
};

/// Objects placed on the bottom at random. Pairs are limits of uniform draws.
struct ScatterConfig {
    std::string name;  ///< the objects are NAME_1, NAME_2, ...
    std::string class_name;
    std::vector<std::string> stock;            ///< kinds of things that come with the program
    std::vector<std::filesystem::path> files;  ///< all equally likely; as many for each of `stock`
    MeshConfig mesh;
    std::array<double, 2> count{1, 1};
    std::array<double, 2> density_per_m2{};  ///< instead of `count`, unless it is 0
    /// x, y; none: the scene's area, else the bottom.
    std::optional<std::array<double, 2>> area_min_m;
    std::optional<std::array<double, 2>> area_max_m;
    std::array<double, 2> roll_deg{};
    std::array<double, 2> pitch_deg{};
    std::array<double, 2> yaw_deg{0, 360};
    std::array<double, 2> scale{1, 1};
    std::array<double, 2> bury{};  ///< share of the height
    std::array<double, 2> bury_m{};
    double spacing_m = 0.0;  ///< least distance between objects, seen from above
    bool overlap = false;
    bool align = false;
    Location place = {};

    /// The size of the area, if it is given.
    double area_m2() const {
        return ((*area_max_m)[0] - (*area_min_m)[0]) * ((*area_max_m)[1] - (*area_min_m)[1]);
    }

    /// The class of the objects of a file.
    const std::string& class_of(std::size_t file) const {
        if (!class_name.empty()) return class_name;
        return stock.empty() ? name : stock[file / (files.size() / stock.size())];
    }
};

/// The class of unlabelled things, which is background.
inline constexpr const char* clutter_class = "clutter";

/// Unlabelled things on the bottom, which become a rule of `scatter` when a mission is read.
struct ClutterConfig {
    std::array<double, 2> density_per_m2{};
    std::vector<std::string> stock;
    std::array<double, 2> scale{0.3, 1.2};
    std::array<double, 2> bury{0, 0.6};
};

/// An image whose pixels are heights, which becomes the bottom.
struct HeightmapConfig : AppliedMapConfig {
    double cell_m = 0.0;        ///< longest side of the surface's cells; 0: that of the pixels
    double height_scale = 1.0;  ///< metres of a step of the pixels' values
    double height_offset_m = 0.0;
    std::string material;
    std::string class_name;
};

/// The instance that a heightmap makes.
inline constexpr const char* heightmap_instance = "heightmap";

/// The surface of the water, which reflects sound from below.
struct WaterSurfaceConfig {
    double height_m = 0.0;
    double roughness = 0.0;  ///< share of the sound that is not reflected specularly
    bool scatters = false;   ///< scatters sound back, by the speed of the wind
};

struct SceneConfig {
    std::filesystem::path file;            ///< .gltf or .glb; "": objects alone make the scene
    std::filesystem::path materials;       ///< CSV
    std::string material_default = {};     ///< for surfaces without a known material; "": an error
    MeshConfig mesh = {};                  ///< options for `file`
    std::vector<std::string> bottom = {};  ///< patterns of the nodes of `file` that objects rest on
    std::optional<HeightmapConfig> heightmap = {};
    std::optional<SedimentMapConfig> sediment_map = {};
    std::optional<AppliedMapConfig> backscatter_map = {};
    std::optional<SeabedConfig> seabed = {};
    std::vector<ObjectConfig> objects = {};
    std::optional<std::array<double, 2>> area_min_m = {};  ///< x, y: the default area of `scatter`
    std::optional<std::array<double, 2>> area_max_m = {};
    std::vector<ScatterConfig> scatter = {};
    std::optional<ClutterConfig> clutter = {};  ///< empty after reading: a rule of `scatter`
    std::vector<ParticlesConfig> particles = {};
    std::optional<WaterSurfaceConfig> water_surface = {};
    Location place = {};
};

inline constexpr auto length_units = choices_of<LengthUnit>("m", "mm", "cm", "km", "in", "ft");
inline constexpr auto up_axes = choices_of<UpAxis>("y", "z");
inline constexpr auto object_places = choices_of<ObjectPlace>("free", "on_bottom");

/// The factors by which an object is enlarged or made smaller.
inline constexpr Limits any_scale{1e-6, 1e6};

void describe_mesh(auto& v, MeshConfig& c) {
    v.choice("units", c.units, length_units, "unit of the file's lengths");
    v.choice("up", c.up, up_axes, "axis of the file that points up; glTF has y, others often z");
    v.note_given("up", c.up_given);
}

void describe(auto& v, ObjectConfig& c) {
    v.text("name", c.name,
           "name of the one instance that all nodes of the file form; without it each node is an "
           "instance of its own");
    v.path("file", c.file, "a .glb, .gltf, .obj, .stl or .ply file, which several objects may use",
           required);
    v.text("class", c.class_name,
           "class of the object, for labels; default: the class in the file");
    v.array("position_m", c.position_m, any_position_m,
            "position of the file's origin in the world; an object on the bottom uses x and y "
            "only; for a moving object it is relative to the trajectory");
    v.array("rpy_deg", c.rpy_deg, any_angle_deg, "roll, pitch and yaw of the object");
    v.number("scale", c.scale, any_scale, "factor that enlarges the object");
    v.text("material", c.mesh.material,
           "material of the whole object; default: the file's materials");
    describe_mesh(v, c.mesh);
    v.choice("place", c.place_on, object_places,
             "`on_bottom` lowers or raises the object until it touches the bottom");
    v.number("bury_m", c.bury_m, any_position_m,
             "depth to which an object on the bottom is buried; a negative one raises it above the "
             "bottom");
    v.flag("align", c.align, "an object on the bottom stands upright on the slope below it");
    v.section("trajectory", c.trajectory,
              "trajectory of a moving object, written like the vehicle's");
    v.require(c.place_on == ObjectPlace::on_bottom || (c.bury_m == 0.0 && !c.align),
              {"place", "bury_m", "align"}, "bury_m and align need place: on_bottom");
    v.require(!c.trajectory || c.place_on == ObjectPlace::free, {"place", "trajectory"},
              "an object that moves cannot rest on the bottom: its trajectory says where it is");
    v.require(!c.trajectory || !c.name.empty(), {"trajectory"},
              "an object that moves needs a name, for its poses in the metadata");
}

inline constexpr Limits any_share_buried = {-10, 1};

/// Describes the corners of the area of a rule of `scatter` or of all.
void describe_area(auto& v, auto& c, const char* meaning) {
    v.array("area_min_m", c.area_min_m, any_position_m, meaning);
    v.array("area_max_m", c.area_max_m, any_position_m, "its largest x and y");
    v.require(c.area_min_m.has_value() == c.area_max_m.has_value(), {"area_min_m", "area_max_m"},
              "an area needs both area_min_m and area_max_m");
    v.require(
        !c.area_min_m || !c.area_max_m ||
            ((*c.area_min_m)[0] < (*c.area_max_m)[0] && (*c.area_min_m)[1] < (*c.area_max_m)[1]),
        {"area_min_m", "area_max_m"}, "area_min_m must be below area_max_m in x and in y");
}

void describe(auto& v, ScatterConfig& c) {
    v.text("name", c.name, "the objects are the instances NAME_1, NAME_2 and so on", required);
    v.text("stock", c.stock, "kinds of things of the program, in place of `files`");
    v.path("files", c.files,
           "a file of a mesh as in `objects`, or a list of them, each equally likely");
    v.text("class", c.class_name,
           "class of the objects, for labels; default: the kind of `stock`, else NAME; `clutter` "
           "is background");
    v.number("count", c.count, {0, 1e5}, "number of objects");
    v.number("density_per_m2", c.density_per_m2, between(0, 1e3),
             "objects for each square metre, in place of `count`");
    describe_area(v, c,
                  "least x and y of the area, in which objects lie wholly; default: that of the "
                  "scene, else the bottom");
    v.number("yaw_deg", c.yaw_deg, any_angle_deg, "heading of an object");
    v.number("roll_deg", c.roll_deg, any_angle_deg, "roll of an object");
    v.number("pitch_deg", c.pitch_deg, any_angle_deg, "pitch of an object");
    v.number("scale", c.scale, any_scale, "factor that enlarges an object");
    v.text("material", c.mesh.material, "material of the objects; default: the files' materials");
    describe_mesh(v, c.mesh);
    v.number("bury", c.bury, any_share_buried,
             "share of the height that is buried; a negative one raises");
    v.number("bury_m", c.bury_m, any_position_m,
             "depth to which an object is buried, besides `bury`; a negative one raises it");
    v.number("spacing_m", c.spacing_m, at_least(0),
             "least distance between two objects, seen from above");
    v.flag("overlap", c.overlap, "objects may lie on and in others");
    v.flag("align", c.align, "objects stand upright on the slope below them");
    v.require(!c.files.empty(), {"stock", "files"}, "a rule of 'scatter' needs 'stock' or 'files'");
    v.require(c.stock.empty() || c.files.size() % c.stock.size() == 0, {"stock", "files"},
              "'stock' and 'files': give one of the two");
    v.require(c.count[0] == std::floor(c.count[0]) && c.count[1] == std::floor(c.count[1]),
              {"count"}, "'count' must be a whole number or two of them");
}

void describe(auto& v, ClutterConfig& c) {
    v.number("density_per_m2", c.density_per_m2, between(0, 1e3), "as in `scatter`", required);
    v.text("stock", c.stock, "default: stones, boards, panels, ropes, weed and others");
    v.number("scale", c.scale, any_scale, "as in `scatter`");
    v.number("bury", c.bury, any_share_buried, "as in `scatter`");
}

void describe(auto& v, HeightmapConfig& c) {
    v.path("file", c.file,
           "an image of one channel, PNG, TIFF (GeoTIFF) or OpenEXR, whose pixels are heights and "
           "whose first row is the north",
           required);
    describe_image_place(v, c);
    v.number("cell_m", c.cell_m, between(0, 1e6),
             "cells of at most this side, by cubic interpolation of the heights; 0: the pixels");
    v.number("height_scale", c.height_scale, {-any_scale.high, any_scale.high},
             "metres for each step of the pixels' values; -1 for depths");
    v.number("height_offset_m", c.height_offset_m, any_position_m,
             "height of the value 0 in the world");
    v.text("material", c.material, "material of the bottom; default: scene.material_default");
    v.text("class", c.class_name, "class of the bottom, for labels");
    v.require(c.height_scale != 0.0, {"height_scale"}, "height_scale of 0 makes all flat");
}

void describe(auto& v, WaterSurfaceConfig& c) {
    v.number("height_m", c.height_m, any_position_m, "height of the surface in the world",
             required);
    v.number("roughness", c.roughness, between(0, 1),
             "share of the sound that the surface scatters away instead of reflecting it");
    v.flag("scatters", c.scatters,
           "the surface sends sound back to sonars of the calibrated model, by water.wind_m_s");
}

/// Patterns of the instances that are the bottom: scene.bottom, else the heightmap or the seabed.
inline std::vector<std::string> bottom_patterns(const SceneConfig& scene) {
    if (!scene.bottom.empty()) return scene.bottom;
    if (scene.heightmap) return {heightmap_instance};
    if (scene.seabed) return {seabed_instance};
    return {};
}

void describe(auto& v, SceneConfig& c) {
    v.path("file", c.file,
           "the scene, a .glb, .gltf, .obj, .stl or .ply file; optional if there are objects, a "
           "heightmap or a seabed");
    v.path("materials", c.materials,
           "CSV with the density and speed of sound of every material of the scene", required);
    v.text("material_default", c.material_default,
           "material of surfaces whose material the CSV lacks or the file does not name; without "
           "it they are an error");
    describe_mesh(v, c.mesh);
    v.text("bottom", c.bottom,
           "nodes of `file` that objects rest on; default: the heightmap or seabed, else all nodes "
           "of `file`, else the first object");
    v.section("heightmap", c.heightmap, "an image of heights, which is the bottom");
    v.section("sediment_map", c.sediment_map, "an image whose pixels are materials of the ground");
    v.section("backscatter_map", c.backscatter_map,
              "an image of decibels that are added to the strength of the ground");
    v.section("seabed", c.seabed,
              "a bottom that is made from these numbers and the mission's seed");
    v.list_of("objects", c.objects, 0, "files that are placed in the scene one by one");
    describe_area(v, c, "least x and y of the default area of `scatter` and clutter");
    v.list_of("scatter", c.scatter, 0, "things or files that are placed on the bottom at random");
    v.section("clutter", c.clutter, "unlabelled things over the area, tilted and overlapping");
    v.list_of("particles", c.particles, 0,
              "groups of point targets in the water, for the calibrated model: fish, bubbles and "
              "others");
    v.section(
        "water_surface", c.water_surface,
        "the surface of the water: it reflects multipath and, with `scatters`, is seen itself");
    v.require(!c.file.empty() || c.heightmap || c.seabed || !c.objects.empty(), {},
              "'scene' needs the key 'file', a heightmap, a seabed or objects");
    v.require(!c.heightmap || !c.seabed, {"heightmap", "seabed"},
              "heightmap and seabed are both the bottom; give one of them");
    const auto names_ground = [&](const ObjectConfig& object) {
        return (c.heightmap && object.name == heightmap_instance) ||
               (c.seabed && object.name == seabed_instance);
    };
    v.require(std::ranges::none_of(c.objects, names_ground), {"objects"},
              "an object has the name of the ground, which is 'heightmap' or 'seabed'; "
              "give it another");
}

}  // namespace sonarsim
