#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// A piece of visible surface: a flat parallelogram that stands for `area_m2` of the scene.
struct Sample {
    Eigen::Vector3f position;  ///< centre, sensor frame, m
    Eigen::Vector3f edge_u;    ///< half an edge of the footprint, sensor frame, m
    Eigen::Vector3f edge_v;    ///< half the other edge
    Eigen::Vector3f normal;    ///< unit, turned to face the sonar
    float height_m;            ///< of the sonar above the piece's plane: v . n = height_m / range
    float area_m2;
    std::uint32_t material;  ///< index into Scene::materials
    std::uint32_t instance;  ///< index into Scene::instances
};

/// What a ping sees, sorted by beam. No footprint reaches into another beam by more than a tenth of
/// a beam.
struct Samples {
    std::vector<Sample> items;
    std::vector<std::uint32_t> beam_begin;  ///< beams + 1 offsets into `items`
    /// Surface in view that was left out. Rays: those that met it edge-on to within rounding, or at
    /// no distance. Octree: parts of leaves too small, or too near the sensor's z axis, to be told
    /// from rounding.
    std::uint64_t dropped = 0;
    /// The engine's own estimate of the relative L1 of the noise-free image; NaN when it has none.
    double estimated_l1 = std::numeric_limits<double>::quiet_NaN();

    std::span<const Sample> beam(int j) const {
        return {items.data() + beam_begin[j], items.data() + beam_begin[j + 1]};
    }
};

struct Ray {
    Eigen::Vector3f origin;     ///< sensor frame, m
    Eigen::Vector3f direction;  ///< unit
};

/// Where a ray meets the scene.
struct Intersection {
    float distance_m;        ///< along the ray; infinite when nothing is met
    float rounding_m;        ///< the point at that distance lies on its surface to within this
    Eigen::Vector3f normal;  ///< unit, turned to face the ray's origin
    std::uint32_t material;  ///< index into Scene::materials
    std::uint32_t instance;  ///< index into Scene::instances
};

/// Answers what a sonar sees of a scene. Engines are immutable to their callers: any number of
/// threads may ask at once, and an answer depends on the arguments alone.
class VisibilityEngine {
  public:
    virtual ~VisibilityEngine() = default;

    /// The surface that `view` sees from `T_world_sensor` within its greatest range. Surface nearer
    /// than the least range hides what is behind it; it may be among the samples.
    virtual Samples visible_surface(const View& view, const Pose& T_world_sensor) const = 0;

    /// The first surface that each ray meets. `intersections` has the length of `rays`.
    virtual void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                           std::span<Intersection> intersections) const = 0;

    /// The engine at a moment at which Scene::bodies are at these poses. It shares with this one
    /// what does not move, and must not outlive it. Without this call bodies are not seen. Only
    /// engines of scenes with bodies are asked, and `refusal_of` says which cannot hold them.
    virtual std::unique_ptr<VisibilityEngine> at(std::span<const Pose> /*T_world_body*/) const {
        throw std::logic_error("this engine does not know of bodies that move");
    }

    /// What the user should know about the answers so far: sentences that name the keys to change.
    virtual std::vector<std::string> warnings() const { return {}; }

    /// 1 for the bins of `view` that some surface falls into, seen or hidden, else 0: [beams, range
    /// bins], beam after beam. Surface less than a thousandth of a bin deep may be left out.
    virtual std::vector<std::uint8_t> covered_bins(const View& view,
                                                   const Pose& T_world_sensor) const = 0;
};

}  // namespace sonarsim
