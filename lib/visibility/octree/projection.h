#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "visibility/octree/tree.h"

namespace sonarsim {

/// Pixel coordinates: azimuth in beams, elevation in rows, where row = (z / rho + tan(elevation /
/// 2)) / row height and rho is the distance from the sensor's z axis. On a plane, 1 / rho is linear
/// in z / rho at constant azimuth. Each beam is divided into columns; a pixel is one row of a
/// column.
struct ProjectionGrid {
    Eigen::Matrix3f R_sensor_local;
    Eigen::Vector3f sensor;  ///< scene-local position in the axes of the sensor, m
    int beams;
    int columns_per_beam;
    int columns;
    int rows;
    float beams_per_rad;
    float beams_per_revolution;
    float rows_per_slope;  ///< rows per unit of z / rho
    /// Squared distance from the sensor's z axis below which azimuths are rounding.
    float least_rho2_m2;
    float least_height_m;  ///< least distance of the sensor from a plane, as a divisor
};

/// `leaf_rad` is the angle that a leaf spans as seen from the sonar.
ProjectionGrid projection_grid(const PreparedView& prepared, float leaf_rad);

/// The half edges of a parallelogram in pixel coordinates.
struct Outline {
    float beams_u, beams_v, rows_u, rows_v;
};

/// A facet in the coordinates of the sonar's view.
struct ProjectedFacet {
    Eigen::Vector3f centre;  ///< sensor frame
    Eigen::Vector3f normal;  ///< towards the sonar
    Eigen::Vector3f edge_u;  ///< half edges of the footprint; edge_v has no extent in azimuth
    Eigen::Vector3f edge_v;
    float area_m2;
    float thickness_m;  ///< largest distance of the surface from the facet's plane
    std::uint32_t triangle;
    float beam;         ///< beam coordinate of the centre
    float half_beams;   ///< half extent in beams along edge_u
    float row;          ///< row coordinate of the centre
    float rows_u;       ///< half extent in rows along edge_u
    float half_rows;    ///< half extent in rows along edge_v
    float depth;        ///< 1 / rho at the centre
    float depth_beam;   ///< derivative by beam
    float depth_row;    ///< derivative by row
    float depth_range;  ///< largest difference of depth between the facet and its centre
    Outline outline;    ///< the occluder: the leaf's facet
    float slack;        ///< surface that is nearer by less does not hide the facet
};

enum class Projection {
    in_view,
    out_of_view,
    on_axis,  ///< in view, but the sensor's z axis is so near that the azimuth is rounding
};

/// Projects a facet, in local axes, of a leaf with edges of `leaf_m`. Sets `facet` if the result is
/// `in_view`; the facet may still lie outside the view.
Projection project(const LeafFacet& leaf, float leaf_m, const ProjectionGrid& grid,
                   ProjectedFacet& facet);

}  // namespace sonarsim
