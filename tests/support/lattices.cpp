#include "support/lattices.h"

#include "support/draws.h"

namespace sonarsim::test {

namespace {

using Eigen::Vector3f;

/// Adds bars and faces to a scene, about the origin, some two units wide.
class LatticeBuilder {
  public:
    LatticeBuilder(Draws& draws, Scene& scene) : scene_(scene), welded_(draws.half()) {
        material_ = add_material(scene, draws.between(0.2F, 0.9F));
        scene.instances.emplace_back("lattice");
    }

    void bar(const Vector3f& a, const Vector3f& b, float radius, int sides) {
        add_bar(scene_, a, b, radius, sides, welded_, material_);
    }

    void quad(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d) {
        add_triangle(scene_, a, b, c, material_);
        add_triangle(scene_, a, c, d, material_);
    }

  private:
    Scene& scene_;
    bool welded_;
    std::uint32_t material_ = 0;
};

/// A girder of four chords with frames and diagonals, as of a crane.
void truss(LatticeBuilder& lattice, Draws& draws) {
    const int bays = draws.whole(3, 9);
    const float half = draws.between(0.08F, 0.3F);
    const float radius = draws.scale(0.004F, 0.03F);
    const int sides = draws.whole(3, 8);
    const auto node = [&](int bay, int k) -> Vector3f {
        const float x = -1.0F + 2.0F * static_cast<float>(bay) / static_cast<float>(bays);
        return {x, k == 1 || k == 2 ? half : -half, k >= 2 ? half : -half};
    };
    for (int bay = 0; bay <= bays; ++bay) {
        for (int k = 0; k < 4; ++k) {
            const int next = (k + 1) % 4;
            lattice.bar(node(bay, k), node(bay, next), radius, sides);
            if (bay == bays) continue;
            lattice.bar(node(bay, k), node(bay + 1, k), 1.5F * radius, sides);
            lattice.bar(node(bay, bay % 2 == 0 ? k : next), node(bay + 1, bay % 2 == 0 ? next : k),
                        radius, sides);
        }
    }
}

/// A net of ropes that sags and billows.
void net(LatticeBuilder& lattice, Draws& draws) {
    const int cells = draws.whole(6, 24);
    const float radius = draws.scale(0.001F, 0.01F);
    const float sag = draws.between(0.0F, 0.5F);
    const float slack = draws.between(0.0F, 0.3F) / static_cast<float>(cells);
    std::vector<Vector3f> nodes;
    for (int i = 0; i <= cells; ++i) {
        for (int j = 0; j <= cells; ++j) {
            const float y = -1.0F + 2.0F * static_cast<float>(i) / static_cast<float>(cells);
            const float z = -1.0F + 2.0F * static_cast<float>(j) / static_cast<float>(cells);
            nodes.push_back(Vector3f(sag * (y * y + 0.5F * z), y, z) + slack * draws.in_ball());
        }
    }
    const auto at = [&](int i, int j) -> const Vector3f& { return nodes[i * (cells + 1) + j]; };
    for (int i = 0; i <= cells; ++i) {
        for (int j = 0; j <= cells; ++j) {
            if (i < cells) lattice.bar(at(i, j), at(i + 1, j), radius, 3);
            if (j < cells) lattice.bar(at(i, j), at(i, j + 1), radius, 3);
        }
    }
}

/// A flight of stairs with rails and posts.
void stairs(LatticeBuilder& lattice, Draws& draws) {
    const int treads = draws.whole(6, 20);
    const float half = draws.between(0.15F, 0.5F);
    const float depth = draws.between(0.8F, 1.6F) / static_cast<float>(treads);
    const float radius = draws.scale(0.004F, 0.02F);
    const auto foot = [&](int k, float side) -> Vector3f {
        const float t = -1.0F + 2.0F * static_cast<float>(k) / static_cast<float>(treads);
        return {0.8F * t, side * half, 0.7F * t};
    };
    const Vector3f up(0.0F, 0.0F, draws.between(0.2F, 0.5F));
    for (int k = 0; k < treads; ++k) {
        const Vector3f to_back(depth, 0.0F, 0.0F);
        lattice.quad(foot(k, -1), foot(k, 1), foot(k, 1) + to_back, foot(k, -1) + to_back);
        for (const float side : {-1.0F, 1.0F}) {
            lattice.bar(foot(k, side), foot(k + 1, side), radius, 4);
            lattice.bar(foot(k, side) + up, foot(k + 1, side) + up, radius, 6);
            lattice.bar(foot(k, side), foot(k, side) + up, radius, 6);
        }
    }
}

/// Pipes that turn at right angles.
void pipes(LatticeBuilder& lattice, Draws& draws) {
    const int count = draws.whole(2, 8);
    for (int n = 0; n < count; ++n) {
        Vector3f at = draws.in_ball();
        const float radius = draws.scale(0.006F, 0.08F);
        const int sides = draws.whole(6, 14);
        int axis = draws.whole(0, 2);
        for (int k = draws.whole(3, 7); k > 0; --k) {
            Vector3f next = at;
            next[axis] = draws.between(-1, 1);
            if ((next - at).norm() < 3.0F * radius) continue;
            lattice.bar(at, next, radius, sides);
            at = next;
            axis = (axis + draws.whole(1, 2)) % 3;
        }
    }
}

/// Leaves on stems.
void leaves(LatticeBuilder& lattice, Draws& draws) {
    const int count = draws.whole(60, 400);
    const float length = draws.scale(0.05F, 0.25F);
    const float stem = draws.scale(0.001F, 0.01F);
    const Vector3f root(0.0F, 0.0F, -1.0F);
    for (int n = 0; n < count; ++n) {
        const Vector3f at = draws.in_ball();
        const Vector3f along = length * draws.in_ball().normalized();
        const Vector3f sideways = draws.in_ball().normalized();
        const Vector3f across = draws.between(0.1F, 0.4F) * along.cross(sideways);
        lattice.quad(at, at + 0.5F * along + across, at + along, at + 0.5F * along - across);
        if (n % 8 == 0) lattice.bar(root, at, stem, 3);
    }
}

/// A wheel of two rims with spokes and braces.
void wheel(LatticeBuilder& lattice, Draws& draws) {
    const int count = draws.whole(10, 40);
    const float half = draws.between(0.03F, 0.2F);
    const float radius = draws.scale(0.003F, 0.02F);
    const auto rim = [&](int k, float side) -> Vector3f {
        const SinCos at = sincos(2.0 * pi * (k % count) / count);
        return {side * half, static_cast<float>(at.cos), static_cast<float>(at.sin)};
    };
    for (int k = 0; k < count; ++k) {
        lattice.bar(rim(k, -1), rim(k, 1), radius, 5);
        for (const float side : {-1.0F, 1.0F}) {
            lattice.bar(rim(k, side), rim(k + 1, side), radius, 5);
            lattice.bar({side * half, 0, 0}, rim(k, side), 0.6F * radius, 4);
            lattice.bar(rim(k, side), rim(k + 1, -side), 0.6F * radius, 4);
        }
    }
}

/// A ladder with a cage of hoops.
void ladder(LatticeBuilder& lattice, Draws& draws) {
    const int rungs = draws.whole(8, 24);
    const int cage = draws.whole(6, 12);
    const float half = draws.between(0.1F, 0.25F);
    const float radius = draws.scale(0.004F, 0.02F);
    const auto height = [&](int k) -> float {
        return -1.0F + 2.0F * static_cast<float>(k) / static_cast<float>(rungs);
    };
    const auto hoop = [&](int k, int n) -> Vector3f {
        const SinCos at = sincos(pi * n / cage);
        return {2.0F * half * static_cast<float>(at.sin), half * static_cast<float>(at.cos),
                height(k)};
    };
    for (int k = 0; k < rungs; ++k) {
        lattice.bar({0, half, height(k)}, {0, -half, height(k)}, radius, 6);
        for (int n = 0; n <= cage; ++n) {
            if (k % 2 == 0 && n < cage) lattice.bar(hoop(k, n), hoop(k, n + 1), radius, 4);
            if (n % 2 == 0) lattice.bar(hoop(k, n), hoop(k + 1, n), radius, 4);
        }
    }
}

constexpr std::array shapes{truss, net, stairs, pipes, leaves, wheel, ladder};

/// A sonar for things of size `size_m` at `distance_m`.
SonarConfig draw_sonar(Draws& draws, std::uint32_t number, float size_m, float distance_m) {
    constexpr std::array kinds{SonarKind::imaging,  SonarKind::profiling, SonarKind::imaging,
                               SonarKind::sidescan, SonarKind::imaging,   SonarKind::echosounder,
                               SonarKind::imaging,  SonarKind::scanning};
    SonarConfig config;
    config.kind = kinds[number % kinds.size()];
    config.range_bins = 128;
    config.azimuth_bins = config.kind == SonarKind::imaging ? 64 << (number / 8 % 4) : 64;
    config.range_min_m = 0.2;
    config.range_max_m = static_cast<double>(distance_m + draws.between(0.8F, 1.5F) * size_m);
    config.azimuth_deg = draws.between(30.0F, 90.0F);
    config.elevation_deg = draws.between(10.0F, 25.0F);
    if (config.kind == SonarKind::profiling) config.elevation_deg = draws.between(1.0F, 3.0F);
    if (config.kind == SonarKind::sidescan) {
        config.azimuth_deg = static_cast<double>(draws.between(100.0F, 160.0F));
        config.elevation_deg = static_cast<double>(draws.between(0.25F, 1.0F));
    }
    if (config.kind == SonarKind::scanning) {
        config.azimuth_deg = static_cast<double>(draws.between(1.0F, 3.0F));
        config.sector_deg = config.step_deg = 0.01;  // the head looks ahead
    }
    config.opening_deg = static_cast<double>(draws.between(10.0F, 50.0F));
    return config;
}

}  // namespace

Lattice draw_lattice(std::uint32_t number) {
    Draws draws(number);
    Lattice out;
    out.scene = empty_scene();
    const auto build = shapes[draws.whole(0, static_cast<int>(std::ssize(shapes)) - 1)];
    LatticeBuilder builder(draws, out.scene);
    build(builder, draws);
    const float size = draws.scale(0.5F, 4.0F);  // half of its length, m
    const float distance = size * draws.scale(1.2F, 6.0F);
    out.sonar = draw_sonar(draws, number, size, distance);
    // Upright in half of the scenes, so that posts are parallel to the columns.
    const float yaw = draws.between(-3.14F, 3.14F);
    Eigen::Quaternionf turn(Eigen::AngleAxisf(yaw, Vector3f::UnitZ()));
    if (draws.half()) {
        const Vector3f axis = draws.in_ball().normalized();
        turn = Eigen::AngleAxisf(draws.between(0.0F, 3.14F), axis) * turn;
    }
    // Aside of the boresight by up to half of its size, or anywhere in a side-scan's plane.
    const bool sides = out.sonar.kind == SonarKind::sidescan;
    const double aside = static_cast<double>(sides ? draws.between(-0.8F, 0.8F) : 0.0F);
    const SinCos at = sincos(aside);
    const Vector3f centre =
        distance * Vector3f(static_cast<float>(at.cos), static_cast<float>(at.sin), 0.0F) +
        0.5F * size * draws.in_ball();
    for (Vector3f& p : out.scene.vertices)
        p = centre + size * (turn * p);
    if (draws.half()) {
        const std::uint32_t mud = add_material(out.scene, 0.2F);
        const float x = distance + size * draws.between(0.5F, 1.2F);  // a slope behind the lattice
        const float lean = draws.between(0.0F, 2.0F) * x;
        const float w = 4.0F * x;
        add_quad(out.scene, {x - lean, -w, -w}, {x - lean, w, -w}, {x + lean, w, w},
                 {x + lean, -w, w}, mud);
    }
    return out;
}

}  // namespace sonarsim::test
