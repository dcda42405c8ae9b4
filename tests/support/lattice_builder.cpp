#include "support/lattice_builder.h"

#include <Eigen/Geometry>
#include <cstdint>

#include "core/elementary.h"
#include "core/units.h"
#include "support/shapes.h"

namespace sonarsim::test {

using Eigen::Vector3f;

LatticeBuilder::LatticeBuilder(Draws& draws, Scene& scene)
    : draws_(draws), scene_(scene), welded_(draws.half()) {
    material_ = shapes::add_material(scene, draws.between(0.2F, 0.9F));
    scene.instances.emplace_back("lattice");
}

void LatticeBuilder::bar(const Vector3f& a, const Vector3f& b, float radius, int sides) {
    const Vector3f along = b - a;
    const Vector3f u = along.unitOrthogonal() * radius;
    const Vector3f v = along.normalized().cross(u);
    const auto rim = [&](const Vector3f& centre, int k) -> Vector3f {
        const SinCos at = sincos(2.0 * pi * (k % sides) / sides);
        return centre + static_cast<float>(at.cos) * u + static_cast<float>(at.sin) * v;
    };
    for (int k = 0; k < sides; ++k) {
        quad(rim(a, k), rim(a, k + 1), rim(b, k + 1), rim(b, k));
        if (!welded_) continue;
        triangle(a, rim(a, k), rim(a, k + 1));
        triangle(b, rim(b, k), rim(b, k + 1));
    }
}

void LatticeBuilder::quad(const Vector3f& a, const Vector3f& b, const Vector3f& c,
                          const Vector3f& d) {
    triangle(a, b, c);
    triangle(a, c, d);
}

void LatticeBuilder::triangle(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
    scene_.vertices.insert(scene_.vertices.end(), {a, b, c});
    scene_.triangles.push_back({first, first + 1, first + 2});
    scene_.triangle_material.push_back(material_);
    scene_.triangle_instance.push_back(0);
}

}  // namespace sonarsim::test
