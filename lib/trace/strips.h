#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trace/coherent_faces.h"
#include "trace/coherent_surface.h"
#include "trace/mesh_faces.h"

namespace sonarsim {

/// The face as a strip of a curved surface; nothing if the surface turns about more than one axis.
/// The instance is not set.
std::optional<SceneStrip> strip_of(const MeshFace& face);

/// A strip in the sensor frame.
struct PlacedStrip {
    Eigen::Vector3d first[2], second[2];  ///< the ends of the rulings
    Eigen::Vector3d first_normal, second_normal;
};

/// The specular line of a strip, in parts: on this line the strip's normal lies in one plane with
/// the ruling and the sonar. Empty if the line is on another strip. `on_facet` has the parts'
/// middles on the facet.
struct SpecularParts {
    std::vector<StripOfPing> parts;
    std::vector<Eigen::Vector3d> on_facet;
};
SpecularParts specular_parts(const PlacedStrip& strip);

}  // namespace sonarsim
