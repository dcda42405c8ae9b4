#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "scene/scene.h"
#include "support/draws.h"

namespace sonarsim::test {

/// Adds bars and faces to a scene, about the origin, some two units wide.
class LatticeBuilder {
  public:
    LatticeBuilder(Draws& draws, Scene& scene);

    Draws& draws() { return draws_; }

    /// A prism from a to b. Welded bars that meet in a node share its vertex.
    void bar(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float radius, int sides);

    void quad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
              const Eigen::Vector3f& d);

  private:
    void triangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c);

    Draws& draws_;
    Scene& scene_;
    bool welded_;
    std::uint32_t material_ = 0;
};

/// Builds one shape with draws of the builder.
struct LatticeShape {
    const char* name;
    void (*build)(LatticeBuilder&);
};

}  // namespace sonarsim::test
