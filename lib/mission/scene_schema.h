#pragma once

#include <array>
#include <cmath>

#include "mission/limits.h"
#include "mission/scene_config.h"

// The keys of the scene. As in mission/schema.h.

namespace sonarsim {

inline constexpr std::array length_units{
    Choice<LengthUnit>{"m", LengthUnit::m},     Choice<LengthUnit>{"mm", LengthUnit::mm},
    Choice<LengthUnit>{"cm", LengthUnit::cm},   Choice<LengthUnit>{"km", LengthUnit::km},
    Choice<LengthUnit>{"in", LengthUnit::inch}, Choice<LengthUnit>{"ft", LengthUnit::foot}};
inline constexpr std::array up_axes{Choice<UpAxis>{"y", UpAxis::y}, Choice<UpAxis>{"z", UpAxis::z}};
inline constexpr std::array object_places{Choice<ObjectPlace>{"free", ObjectPlace::free},
                                          Choice<ObjectPlace>{"on_bottom", ObjectPlace::on_bottom}};

inline constexpr std::array repeated_files{Choice<RepeatedFiles>{"auto", RepeatedFiles::automatic},
                                           Choice<RepeatedFiles>{"copied", RepeatedFiles::copied},
                                           Choice<RepeatedFiles>{"shared", RepeatedFiles::shared}};

/// The largest factor by which an object is enlarged or made smaller.
inline constexpr double largest_scale = 1e6;

template <class Visitor>
void describe_mesh(Visitor& v, MeshConfig& c) {
    v.choice("units", c.units, length_units, "unit of the file's lengths");
    v.choice("up", c.up, up_axes,
             "axis of the file that points up; glTF says y, and some exporters write z");
    v.renaming("materials_map", c.materials_map,
               "materials of the file that have another name in the CSV, as {\"0137_Black\": "
               "rubber}");
    v.texts("exclude", c.exclude,
            "names of nodes that are left out; `*` stands for any text and `?` for any one byte");
}

template <class Visitor>
void describe(Visitor& v, ObjectConfig& c) {
    v.place(c.place);
    v.text("name", c.name,
           "makes one instance of all nodes of the file; each is one of its own where left out");
    v.path("file", c.file, "a .gltf or .glb, which may be used many times", required);
    v.text("class", c.class_name, "class of the object, for labels; as the file says if left out");
    v.numbers("position_m", c.position_m, any_position_m,
              "where the file's origin lies in the world; of an object on the bottom x and y "
              "count; of a moving one this is relative to its trajectory");
    v.numbers("rpy_deg", c.rpy_deg, any_angle_deg, "roll, pitch and yaw of the object");
    v.number("scale", c.scale, {1.0 / largest_scale, largest_scale}, "enlarges the object");
    v.text("material", c.mesh.material, "material of the whole object; the file's if left out");
    describe_mesh(v, c.mesh);
    v.choice("place", c.place_on, object_places,
             "`on_bottom` lowers or raises the object until it touches the bottom");
    v.number("bury_m", c.bury_m, any_position_m,
             "how deep an object on the bottom sinks into it; negative: how high it hovers");
    v.flag("align", c.align, "an object on the bottom stands upright on the slope below it");
    v.optional_section("trajectory", c.trajectory,
                       "the object moves: a trajectory like the vehicle's. Waypoints and a "
                       "lawnmower begin with the first ping, a file has its own times");
    v.require(c.place_on == ObjectPlace::on_bottom || (c.bury_m == 0.0 && !c.align),
              {"place", "bury_m", "align"}, "bury_m and align need place: on_bottom");
    v.require(!c.trajectory || c.place_on == ObjectPlace::free, {"place", "trajectory"},
              "an object that moves cannot rest on the bottom: its trajectory says where it is");
    v.require(!c.trajectory || !c.name.empty(), {"trajectory"},
              "an object that moves needs a name, for its poses in the metadata");
}

template <class Visitor>
void describe(Visitor& v, ScatterConfig& c) {
    v.place(c.place);
    v.text("name", c.name, "the objects are the instances NAME_1, NAME_2 and so on", required);
    v.paths("files", c.files, "a .gltf or .glb, or a list of them of which each is as likely",
            required);
    v.text("class", c.class_name, "class of the objects, for labels; NAME where left out");
    v.range("count", c.count, {0, 1e5}, "how many objects");
    v.numbers("area_min_m", c.area_min_m, any_position_m,
              "corner of the area with the least x and y; objects lie wholly within", required);
    v.numbers("area_max_m", c.area_max_m, any_position_m,
              "corner of the area with the largest x and y", required);
    v.range("yaw_deg", c.yaw_deg, any_angle_deg, "heading of an object");
    v.range("roll_deg", c.roll_deg, any_angle_deg, "roll of an object");
    v.range("pitch_deg", c.pitch_deg, any_angle_deg, "pitch of an object");
    v.range("scale", c.scale, {1.0 / largest_scale, largest_scale}, "enlarges an object");
    v.text("material", c.mesh.material, "material of the objects; the files' if left out");
    describe_mesh(v, c.mesh);
    v.range("bury_m", c.bury_m, any_position_m, "how deep an object sinks into the bottom");
    v.number("spacing_m", c.spacing_m, at_least(0),
             "least distance between two objects, seen from above");
    v.flag("align", c.align, "objects stand upright on the slope below them");
    v.integer("tries", c.tries, between(1, 1e6), "places that are tried for each object");
    v.require(c.area_min_m[0] < c.area_max_m[0] && c.area_min_m[1] < c.area_max_m[1],
              {"area_min_m", "area_max_m"}, "area_min_m must be below area_max_m in x and in y");
    v.require(c.count[0] == std::floor(c.count[0]) && c.count[1] == std::floor(c.count[1]),
              {"count"}, "'count' must be a whole number or two of them");
}

template <class Visitor>
void describe(Visitor& v, WaterSurfaceConfig& c) {
    v.number("height_m", c.height_m, any_position_m, "height of the surface in the world",
             required);
    v.number("roughness", c.roughness, between(0, 1),
             "share of the sound that the surface scatters away instead of mirroring it");
}

template <class Visitor>
void describe(Visitor& v, SceneConfig& c) {
    v.place(c.place);
    v.path("file", c.file, "the scene, a .gltf or .glb; may be left out where there are objects");
    v.path("materials", c.materials,
           "CSV with the density and speed of sound of every material of the scene", required);
    v.text("material_default", c.material_default,
           "material for what the CSV lacks or the file does not name; an error if left out");
    describe_mesh(v, c.mesh);
    v.texts("bottom", c.bottom,
            "nodes of `file` that objects rest on; all of them where left out, and the first "
            "object where there is no `file`");
    v.list("objects", c.objects, 0, "files that are put into the scene, one by one");
    v.list("scatter", c.scatter, 0, "files that are strewn over the bottom at random");
    v.choice("repeats", c.repeats, repeated_files,
             "a file that is used again: `copied` repeats its triangles; `shared` keeps them once, "
             "for objects with names that stand still, and only rays see them; `auto` shares when "
             "the copies have more than four million triangles and the engine can be rays");
    v.optional_section("water_surface", c.water_surface,
                       "the surface of the water: a mirror for multipath, and invisible otherwise");
    v.require(!c.file.empty() || !c.objects.empty(), {}, "'scene' needs the key 'file' or objects");
}

}  // namespace sonarsim
