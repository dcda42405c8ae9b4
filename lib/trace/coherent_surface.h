#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

// The surface of a ping that reflects coherently, in the sensor frame, m.

namespace sonarsim {

/// A part of a plate's border.
struct PlateEdge {
    Eigen::Vector3d from, to;
    bool seen = true;  ///< it is in view, and the plate next to its middle is not hidden
};

/// A face of a corner, which reflects sound on its way.
struct Mirror {
    std::uint32_t material = 0;  ///< index into Scene::materials
    double sine = 1.0;           ///< sine of the grazing angle
};

/// A flat face, or the plate in whose place a corner reflects.
struct PlateOfPing {
    std::vector<PlateEdge> edges;
    Eigen::Vector3d normal;       ///< unit, away from the sonar
    double height_m = 0.0;        ///< the sonar's height above its plane
    bool foot_seen = true;        ///< the foot of the perpendicular is visible
    std::uint32_t material = 0;   ///< index into Scene::materials
    std::vector<Mirror> mirrors;  ///< the faces of a corner; empty: the plate itself reflects
    float strength = 1.0F;        ///< factor on its power, from a map
};

/// A part of the specular line of a cylinder: there the normal points at the line through the sonar
/// that is parallel to the cylinder's axis.
struct StripOfPing {
    Eigen::Vector3d from, to;
    double radius_m = 0.0;       ///< negative if the cylinder is hollow
    std::uint32_t material = 0;  ///< index into Scene::materials
    float strength = 1.0F;       ///< factor on its power, from a map
};

/// The plane of a face that reflects coherently. It scatters less sound incoherently.
struct FaceOfPing {
    std::uint32_t instance = 0;  ///< index into Scene::instances
    std::uint32_t material = 0;  ///< index into Scene::materials
    Eigen::Vector3d normal;      ///< unit, away from the sonar
    double height_m = 0.0;       ///< the sonar's height above the plane
};

struct CoherentSurface {
    std::vector<PlateOfPing> plates;
    std::vector<StripOfPing> strips;
    std::vector<FaceOfPing> faces;  ///< in the order of instances, then of normal.x()

    bool has_echoes() const { return !plates.empty() || !strips.empty(); }
};

/// The rectangle along a line from `left_m` on one side of it to `right_m` on the other. `across`:
/// unit, at right angles to the line.
PlateOfPing plate_along(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& across, double left_m, double right_m);

}  // namespace sonarsim
