#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "trace/coherent_faces.h"
#include "trace/coherent_surface.h"

// Corner reflectors. Two faces at right angles reflect sound like a plate through their seam that
// faces the sonar across the seam; three faces like a plate through their common point that faces
// the sonar. The plate is the part of its plane through which a reflected ray meets each of the
// faces: the overlap of the opening and its point reflection (e.g. Knott, Shaeffer and Tuley,
// "Radar Cross Section", 2004, chapter 6). Its target strength is 20 log(A / lambda) for an area A;
// three right triangles of side a on the axis have A = a^2 / sqrt(3).

namespace sonarsim {

/// Fills the dihedrals and trihedrals from the plates.
void find_corners(CoherentFaces& faces);

/// A face of a corner in the sensor frame.
struct CornerFace {
    Eigen::Vector3d outwards;  ///< its normal, unit, towards the sonar
    std::vector<std::array<Eigen::Vector3d, 2>> border;
    std::uint32_t material = 0;
};

/// The plate in whose place a corner reflects, and the points that it depends on, one of each face.
struct Aperture {
    PlateOfPing plate;
    std::vector<Eigen::Vector3d> points;
};

/// The apertures of the parts of a seam, from one end to the other.
std::vector<Aperture> dihedral_apertures(const std::array<CornerFace, 2>& faces,
                                         const Eigen::Vector3d& from, const Eigen::Vector3d& to);

std::optional<Aperture> trihedral_aperture(const std::array<CornerFace, 3>& faces,
                                           const Eigen::Vector3d& apex);

}  // namespace sonarsim
