#include "support/lattices_kept_aside.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim::test {

namespace {

using Eigen::Vector3f;

Vector3f on_circle(double turns) {
    const SinCos at = sincos(2.0 * pi * turns);
    return {0.0F, static_cast<float>(at.cos), static_cast<float>(at.sin)};
}

/// Parallel blades, thin and tilted.
void louvre(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int blades = draws.whole(5, 40);
    const float half = draws.between(0.2F, 1.0F);
    const float width = draws.between(0.3F, 1.5F) / static_cast<float>(blades);
    const Vector3f across = width * on_circle(static_cast<double>(draws.between(0.0F, 1.0F)));
    for (int k = 0; k < blades; ++k) {
        const float z = -1.0F + 2.0F * static_cast<float>(k) / static_cast<float>(blades - 1);
        const Vector3f middle(0.0F, 0.0F, z);
        // The frame is turned so that blades run along y and tilt about it.
        const Vector3f tilt(across.y(), 0.0F, across.z());
        const Vector3f along(0.0F, half, 0.0F);
        lattice.quad(middle - along - tilt, middle + along - tilt, middle + along + tilt,
                     middle - along + tilt);
    }
}

/// Blades that bend and get narrower, on a flat bed.
void grass(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int count = draws.whole(60, 500);
    const float width = draws.scale(0.002F, 0.03F);
    const float bend = draws.between(0.0F, 0.6F);
    for (int n = 0; n < count; ++n) {
        Vector3f foot = draws.in_ball();
        foot.z() = -1.0F;
        const Vector3f lean = bend * draws.in_ball();
        const float height = draws.between(0.4F, 1.6F);
        const Vector3f side = width * on_circle(static_cast<double>(draws.between(0.0F, 1.0F)));
        const Vector3f flat(side.y(), side.z(), 0.0F);
        const auto at = [&](float t) -> Vector3f {
            return foot + t * Vector3f(0.0F, 0.0F, height) + t * t * lean;
        };
        lattice.quad(at(0.0F) - flat, at(0.0F) + flat, at(0.5F) + 0.7F * flat,
                     at(0.5F) - 0.7F * flat);
        lattice.triangle(at(0.5F) - 0.7F * flat, at(0.5F) + 0.7F * flat, at(1.0F));
    }
}

/// Helices of wire.
void springs(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int count = draws.whole(1, 4);
    for (int n = 0; n < count; ++n) {
        const int turns = draws.whole(3, 14);
        const int steps = draws.whole(10, 20);
        const float radius = draws.between(0.1F, 0.5F);
        const float wire = draws.scale(0.004F, 0.04F);
        const Vector3f middle = 0.5F * draws.in_ball();
        const auto at = [&](int k) -> Vector3f {
            const double turn = static_cast<double>(k) / steps;
            const float x = -1.0F + 2.0F * static_cast<float>(turn) / static_cast<float>(turns);
            return middle + radius * on_circle(turn) + Vector3f(x, 0.0F, 0.0F);
        };
        for (int k = 0; k < turns * steps; ++k)
            lattice.bar(at(k), at(k + 1), wire, 4);
    }
}

/// Chains of long links, each turned by a quarter against the one before.
void chains(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int count = draws.whole(1, 5);
    for (int n = 0; n < count; ++n) {
        const int links = draws.whole(5, 16);
        const float wire = draws.scale(0.005F, 0.025F);
        const float sag = draws.between(0.0F, 0.8F);
        const float half = 1.3F / static_cast<float>(links);
        const Vector3f shift = 0.6F * draws.in_ball();
        for (int k = 0; k < links; ++k) {
            const float y =
                -1.0F + (2.0F * static_cast<float>(k) + 1.0F) / static_cast<float>(links);
            const Vector3f middle = shift + Vector3f(0.0F, y, sag * y * y);
            const Vector3f across =
                0.5F * half * (k % 2 == 0 ? Vector3f::UnitX() : Vector3f::UnitZ());
            constexpr int corners = 10;
            const auto at = [&](int c) -> Vector3f {
                const Vector3f p = on_circle(static_cast<double>(c % corners) / corners);
                return middle + p.y() * Vector3f(0.0F, half, 0.0F) + p.z() * across;
            };
            for (int c = 0; c < corners; ++c)
                lattice.bar(at(c), at(c + 1), wire, 5);
        }
    }
}

/// A plate, slightly curved, with square holes; some have none.
void perforated(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int cells = draws.whole(4, 16);
    const float bridge = draws.between(0.05F, 0.45F);  // half of what is left between two holes
    const float curve = draws.between(-0.6F, 0.6F);
    const float closed = draws.between(0.0F, 0.6F);
    const auto at = [&](float u, float v) -> Vector3f {
        const float y = -1.0F + 2.0F * u / static_cast<float>(cells);
        const float z = -1.0F + 2.0F * v / static_cast<float>(cells);
        return {curve * (y * y + 0.3F * z), y, z};
    };
    const auto sheet = [&](float u0, float u1, float v0, float v1) {
        lattice.quad(at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1));
    };
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const auto u = static_cast<float>(i);
            const auto v = static_cast<float>(j);
            if (draws.between(0.0F, 1.0F) < closed) {
                sheet(u, u + 1.0F, v, v + 1.0F);
                continue;
            }
            sheet(u, u + 1.0F, v, v + bridge);
            sheet(u, u + 1.0F, v + 1.0F - bridge, v + 1.0F);
            sheet(u, u + bridge, v + bridge, v + 1.0F - bridge);
            sheet(u + 1.0F - bridge, u + 1.0F, v + bridge, v + 1.0F - bridge);
        }
    }
}

/// A trunk whose branches fork, each thinner than the one before.
void tree(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    struct Branch {
        Vector3f foot;
        Vector3f along;
        float radius;
        int depth;
    };
    const int forks = draws.whole(2, 4);
    const int depth = forks == 2 ? 6 : 4;
    const float spread = draws.between(0.3F, 1.0F);
    const float taper = draws.between(0.4F, 0.75F);
    std::vector<Branch> open{{Vector3f(0.0F, 0.0F, -1.0F), Vector3f(0.0F, 0.0F, 0.7F),
                              draws.scale(0.01F, 0.06F), depth}};
    while (!open.empty()) {
        const Branch b = open.back();
        open.pop_back();
        const Vector3f tip = b.foot + b.along;
        lattice.cone(b.foot, tip, b.radius, taper * b.radius, 5);
        for (int k = 0; k < forks && b.depth > 1; ++k) {
            const Vector3f turn = spread * b.along.norm() * draws.in_ball();
            open.push_back({tip, 0.75F * (b.along + turn), taper * b.radius, b.depth - 1});
        }
    }
}

/// Tetrahedra of many sizes, touching or apart.
void rubble(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int count = draws.whole(30, 500);
    const float smallest = draws.scale(0.005F, 0.05F);
    for (int n = 0; n < count; ++n) {
        const Vector3f at = draws.in_ball().cwiseProduct(Vector3f(1.0F, 1.0F, 0.4F));
        const float size = draws.scale(smallest, 0.2F);
        std::array<Vector3f, 4> p;
        for (Vector3f& corner : p)
            corner = at + size * draws.in_ball();
        lattice.triangle(p[0], p[1], p[2]);
        lattice.triangle(p[0], p[3], p[1]);
        lattice.triangle(p[1], p[3], p[2]);
        lattice.triangle(p[2], p[3], p[0]);
    }
}

/// Frames of a hull, flat and curved, with stringers and some plates.
void frames(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int count = draws.whole(6, 20);
    constexpr int corners = 12;
    const float web = draws.scale(0.01F, 0.08F);
    const float stringer = draws.scale(0.003F, 0.02F);
    const float plated = draws.between(0.0F, 0.3F);
    const auto at = [&](int k, int c, float inside) -> Vector3f {
        const float x = -1.0F + 2.0F * static_cast<float>(k) / static_cast<float>(count);
        const float beam = 0.6F * std::sqrt(1.02F - x * x) - inside;
        // From one deck edge below the keel to the other.
        const Vector3f p = on_circle(0.5 + 0.5 * static_cast<double>(c) / corners);
        return {x, beam * p.y(), 0.8F * beam * p.z()};
    };
    for (int k = 0; k < count; ++k) {
        for (int c = 0; c < corners; ++c) {
            lattice.quad(at(k, c, 0.0F), at(k, c + 1, 0.0F), at(k, c + 1, web), at(k, c, web));
            if (c % 3 == 0 && c > 0) lattice.bar(at(k, c, 0.0F), at(k + 1, c, 0.0F), stringer, 4);
            if (draws.between(0.0F, 1.0F) < plated)
                lattice.quad(at(k, c, 0.0F), at(k, c + 1, 0.0F), at(k + 1, c + 1, 0.0F),
                             at(k + 1, c, 0.0F));
        }
    }
}

/// A body of flat faces with long spikes.
void urchin(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int spikes = draws.whole(20, 150);
    const float body = draws.between(0.1F, 0.5F);
    const float root = draws.scale(0.005F, 0.05F);
    constexpr int rings = 8;
    const auto on_body = [&](int ring, int k) -> Vector3f {
        const SinCos polar = sincos(pi * ring / rings);
        const Vector3f around = on_circle(static_cast<double>(k) / 12.0);
        return body * (static_cast<float>(polar.sin) * around +
                       static_cast<float>(polar.cos) * Vector3f::UnitX());
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int k = 0; k < 12; ++k)
            lattice.quad(on_body(ring, k), on_body(ring, k + 1), on_body(ring + 1, k + 1),
                         on_body(ring + 1, k));
    }
    for (int n = 0; n < spikes; ++n) {
        const Vector3f out = draws.in_ball().normalized();
        lattice.cone(0.95F * body * out, draws.between(0.7F, 1.1F) * out, root, 0.05F * root, 4);
    }
}

/// A crumpled sheet with missing triangles.
void crumpled(LatticeBuilder& lattice) {
    Draws& draws = lattice.draws();
    const int cells = draws.whole(6, 30);
    const float depth = draws.between(0.05F, 1.5F) / static_cast<float>(cells);
    const float holes = draws.between(0.0F, 0.6F);
    std::vector<Vector3f> nodes;
    for (int i = 0; i <= cells; ++i) {
        for (int j = 0; j <= cells; ++j) {
            const float y = -1.0F + 2.0F * static_cast<float>(i) / static_cast<float>(cells);
            const float z = -1.0F + 2.0F * static_cast<float>(j) / static_cast<float>(cells);
            nodes.push_back(Vector3f(0.3F * y * z, y, z) + depth * draws.in_ball());
        }
    }
    const auto at = [&](int i, int j) -> const Vector3f& { return nodes[i * (cells + 1) + j]; };
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            if (draws.between(0.0F, 1.0F) >= holes)
                lattice.triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            if (draws.between(0.0F, 1.0F) >= holes)
                lattice.triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
}

constexpr std::array<LatticeShape, 10> kept_aside{{{"louvre", louvre},
                                                   {"grass", grass},
                                                   {"springs", springs},
                                                   {"chains", chains},
                                                   {"perforated", perforated},
                                                   {"tree", tree},
                                                   {"rubble", rubble},
                                                   {"frames", frames},
                                                   {"urchin", urchin},
                                                   {"crumpled", crumpled}}};

}  // namespace

std::span<const LatticeShape> shapes_kept_aside() {
    return kept_aside;
}

}  // namespace sonarsim::test
