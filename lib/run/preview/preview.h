#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/product/picture.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Blends a colour over a pixel with the weight `share`. Pixels outside the picture are ignored.
void tint(Picture& picture, int x, int y, Rgb colour, float share);

/// Draws a straight line, one pixel wide, between two points in pixels, clipped to the picture.
void draw_line(Picture& picture, Eigen::Vector2d from, Eigen::Vector2d to, Rgb colour,
               float share = 1.0F);

/// Draws a square of 2 `half` + 1 pixels around a point.
void draw_dot(Picture& picture, const Eigen::Vector2d& at, int half, Rgb colour);

/// Writes a text whose middle is at the height y.
void label(Picture& picture, int x, int y, std::string text, Align align, Rgb colour = ink);

/// The same with a dark outline.
void outlined_label(Picture& picture, int x, int y, const std::string& text, Align align,
                    Rgb colour);

/// Copies a picture into another one, which must be large enough.
void paste(Picture& picture, const Picture& part, int x, int y);

/// The mapping of a plane to a tile with one scale, m to px, and margins for the numbers of axes.
struct PlaneFrame {
    int left = 0;  ///< left edge of the plot, whose top is that of the tile, px
    int plot_width = 0;
    int plot_height = 0;
    Eigen::Vector2d low;  ///< at the lower left corner of the plot, m
    double pixel_m = 1.0;

    Eigen::Vector2d pixel(const Eigen::Vector2d& at_m) const;
    /// The place of the middle of a pixel of the plot, m.
    Eigen::Vector2d metres(int column, int row) const;
};

/// The frame that shows `low` to `high` at its centre.
PlaneFrame plane_frame(int width, int height, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high);

/// Darkens the margins and writes the numbers of both axes there.
void draw_axes(Picture& tile, const PlaneFrame& frame);

/// The ends of rays along the edge of a sonar's view, on a surface or at the largest range.
struct BeamOutline {
    Eigen::Vector3d origin;             ///< position of the sonar, world
    std::vector<Eigen::Vector3d> ends;  ///< end points once around, world
    Rgb colour;
};

BeamOutline beam_outline(const Sonar& sonar, const VisibilityEngine& engine,
                         const Pose& T_world_sensor, Rgb colour);

/// A mission at a pose as a binary glTF file, for any viewer: the surfaces of the scene in colours
/// of their classes (background grey), the trajectory, and the edges of the sonars' views. Metres
/// from Scene::origin, turned from z up to the y up of glTF. Nodes have the names of instances,
/// and the names of class and object in `extras`.
std::string scene_gltf(const Assembly& assembly, std::uint32_t pose,
                       const std::vector<BeamOutline>& beams);

/// A mission at one pose of its trajectory.
struct Moment {
    const Assembly& assembly;
    const VisibilityEngine& engine;  ///< the scene at that time
    std::uint32_t pose;
    std::vector<BeamOutline> beams;  ///< one per sonar
};

/// The height (world z) of the highest surface below the vehicle in each pixel of a plot of the
/// world's x and y, row by row from the top; NaN where there is no surface.
std::vector<float> heights_below(const VisibilityEngine& engine, const Eigen::Vector3d& vehicle,
                                 const PlaneFrame& frame);

/// Draws a plan, north (y) up: the height of the highest surface below the vehicle, dark where
/// there is none, the trajectory, the footprints of the sonars and the boxes and names of objects.
Picture draw_plan(const Moment& moment, int width, int height);

/// An object of the scene and the box around it, world.
struct ObjectBox {
    std::string name;
    Eigen::AlignedBox3d box;
};

/// The objects at a pose of the trajectory, without those that are background. Nodes of the scene
/// are the objects if the mission asks for no labels and has no classes.
std::vector<ObjectBox> object_boxes(const Assembly& assembly, std::uint32_t pose);

/// Draws the boxes in a plan of x and y, without those that fill most of it, and the names for
/// which there is room, those of large objects first. Returns the boxes of the names, px.
std::vector<Eigen::AlignedBox2d> draw_objects(Picture& tile, const PlaneFrame& frame,
                                              const std::vector<ObjectBox>& objects);

/// A sonar's picture around a ping.
struct SonarPanel {
    Picture picture;
    double white;  ///< intensity of the brightest colour
};

/// Renders a ping of the sonar by the index of its pose. It is called from several threads at once.
using RenderPing = std::function<Ping(std::uint32_t pose)>;

/// The last pose at or before `pose` at which the sonar pings.
std::uint32_t ping_at(const Sonar& sonar, std::uint32_t pose);

/// Draws at most `width` by `height` pixels: the fan of a sonar with images, with rings and
/// bearings, the display of a scanning sonar, or the waterfall or echogram around the ping, with
/// two marks at it. The brightness is derived from the shown pings.
SonarPanel draw_sonar(const Sonar& sonar, std::uint32_t pose, std::size_t poses,
                      const RenderPing& render, int width, int height);

/// A picture of a mission at a pose, and the edges of the views of its sonars there.
struct Preview {
    Picture picture;
    std::vector<BeamOutline> beams;
};

/// Draws each sonar's image at a pose of the trajectory, and a plan of scene, trajectory and
/// footprints. std::runtime_error when memory does not suffice.
Preview draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose);

}  // namespace sonarsim
