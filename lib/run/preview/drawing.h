#pragma once

#include <Eigen/Core>
#include <string>

#include "simulate/product/picture.h"

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

/// The mapping of a plane to a tile: metres to pixels, with the same scale on both axes and margins
/// for the numbers of the axes.
struct PlaneFrame {
    int left = 0;  ///< plot in a tile, from its upper edge on, px
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

}  // namespace sonarsim
