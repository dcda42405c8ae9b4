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

/// A flat face.
struct PlateOfPing {
    std::vector<PlateEdge> edges;
    Eigen::Vector3d normal;      ///< unit, away from the sonar
    double height_m = 0.0;       ///< the sonar's height above its plane
    bool foot_seen = true;       ///< the foot of the perpendicular is visible
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
    std::vector<FaceOfPing> faces;  ///< in the order of instances, then of normal.x()

    bool has_echoes() const { return !plates.empty(); }
};

}  // namespace sonarsim
