#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "visibility/octree/search.h"
#include "visibility/view.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// How directions are counted: azimuth in beams, elevation in rows, where row = (z / rho +
/// tan(elevation / 2)) / row height and rho is the distance from the sensor's z axis. On a plane,
/// 1 / rho is linear in z / rho along an azimuth. Each beam is divided into columns; a column and a
/// row cross in a pixel.
struct ProjectionGrid {
    int beams;
    int columns_per_beam;
    int columns;
    int rows;
    float beams_per_rad;
    float beams_per_revolution;
    float rows_per_slope;  ///< of z / rho
    float least_rho2_m2;   ///< nearer to the sensor's z axis no azimuth can be told from rounding
    float least_height_m;  ///< of the sensor above a plane, as a divisor
};

/// `leaf_rad` is the angle that a leaf spans as seen from the sonar.
ProjectionGrid projection_grid(const View& view, float leaf_rad);

/// A facet as the sonar sees it.
struct ProjectedFacet {
    Eigen::Vector3f centre;  ///< sensor frame
    Eigen::Vector3f normal;  ///< towards the sonar
    Eigen::Vector3f edge_u;  ///< half edges of the footprint; edge_v has no extent in azimuth
    Eigen::Vector3f edge_v;
    float area_m2;
    float thickness_m;  ///< by how much the surface strays from the facet's plane
    std::uint32_t triangle;
    float beam;         ///< of the centre
    float half_beams;   ///< along edge_u
    float row;          ///< of the centre
    float rows_u;       ///< along edge_u
    float half_rows;    ///< along edge_v
    float depth;        ///< 1 / rho of the centre
    float depth_beam;   ///< its derivative by beam
    float depth_row;    ///< its derivative by row
    float depth_range;  ///< by how much the depth of the facet may differ from the centre's
    float slack;        ///< what is nearer by less does not hide the facet
};

/// The outline of a facet as it hides what lies behind: half edges of a parallelogram.
struct Outline {
    float beams_u;
    float beams_v;
    float rows_u;
    float rows_v;
};

/// Projects the facets of a run and appends those that the view may see to `facets`, with their
/// outlines in step. A facet that reaches over the half plane behind the sonar, where azimuths
/// jump, is appended once for either end. Returns how many facets are left out although the view
/// reaches them: their centre lies on the sensor's z axis to within rounding.
int project(const LeafRun& run, const ViewVolume& volume, const ProjectionGrid& grid,
            std::vector<ProjectedFacet>& facets, std::vector<Outline>& outlines);

}  // namespace sonarsim
