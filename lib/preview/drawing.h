#pragma once

#include <Eigen/Core>
#include <string>

#include "product/picture.h"

namespace sonarsim {

/// Draws `share` of a colour over a pixel; nothing outside the picture.
void tint(Picture& picture, int x, int y, Rgb colour, float share);

/// A straight line between two points in pixels, of one pixel; parts outside are left out.
void draw_line(Picture& picture, Eigen::Vector2d from, Eigen::Vector2d to, Rgb colour,
               float share = 1.0F);

/// A square of 2 `half` + 1 pixels around a point.
void draw_dot(Picture& picture, const Eigen::Vector2d& at, int half, Rgb colour);

/// Copies a picture into another one, which must have room for it.
void paste(Picture& picture, const Picture& part, int x, int y);

/// A piece of a plane in a tile: metres to pixels, the same scale both ways, with margins for the
/// numbers of its axes.
struct PlaneFrame {
    int width = 0;  ///< of the tile, px
    int height = 0;
    int left = 0;  ///< of the plot in the tile, px
    int top = 0;
    int plot_width = 0;
    int plot_height = 0;
    Eigen::Vector2d low;  ///< at the lower left corner of the plot, m
    double pixel_m = 1.0;

    Eigen::Vector2d pixel(const Eigen::Vector2d& at_m) const;
    /// Of the middle of a pixel of the plot.
    Eigen::Vector2d metres(int column, int row) const;
};

/// The frame that shows `low` to `high` in the middle.
PlaneFrame plane_frame(int width, int height, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high);

/// Darkens what is beside the plot and writes the numbers of both axes there.
void draw_axes(Picture& tile, const PlaneFrame& frame);

}  // namespace sonarsim
