#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "support/maps.h"
#include "support/scenes.h"
#include "support/smooth_shapes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr float reflection = 0.5F;

class CornerDraws {
  public:
    explicit CornerDraws(unsigned seed) : random_(seed) {}
    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
    }
    int whole(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  private:
    std::mt19937 random_;
};

Scene smooth_scene() {
    Scene scene = empty_scene();
    scene.materials[add_material(scene, reflection)].roughness_m = 0.0;
    // Keeps the scene's bounds.
    scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
    add_quad(scene, {-40, -40, -40}, {-39, -40, -40}, {-39, -39, -40}, {-40, -39, -40}, 1);
    return scene;
}

void add_polygon(Scene& scene, const std::vector<Eigen::Vector3d>& corners) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const Eigen::Vector3d& corner : corners)
        scene.vertices.push_back(corner.cast<float>());
    for (std::uint32_t k = 2; k < corners.size(); ++k) {
        scene.triangles.push_back({first, first + k - 1, first + k});
        scene.triangle_material.push_back(0);
        scene.triangle_instance.push_back(0);
    }
}

/// A face of a corner at the origin, moved to a range, turned so that `towards` points at the
/// sonar.
struct Mount {
    Eigen::Matrix3d R;
    Eigen::Vector3d apex;

    Mount(const Eigen::Vector3d& look, double range, const Eigen::Vector3d& towards, double roll)
        : R((Eigen::AngleAxisd(roll, look) * Eigen::Quaterniond::FromTwoVectors(towards, -look))
                .toRotationMatrix()),
          apex(range * look) {}

    void add(Scene& scene, std::vector<Eigen::Vector3d> corners) const {
        for (Eigen::Vector3d& corner : corners)
            corner = apex + R * corner;
        add_polygon(scene, corners);
    }
};

/// The level of an area that faces the sonar far away.
double far_db(double area, double power, double wavelength, double range) {
    return 20.0 * std::log10(area / (wavelength * range * range)) + 10.0 * std::log10(power);
}

}  // namespace

TEST_SUITE("calibrated") {
    // Faces b1 and b2 wide under the angle t: A = 2 L min(b1 sin t, b2 cos t), broadside.
    TEST_CASE("corners: dihedrals of two rectangles") {
        CornerDraws draws(25);
        for (int trial = 0; trial < 15; ++trial) {
            const Looking from = looking(kinds_before_shapes[trial % 5], draws.number(1e5, 4e5));
            const double wavelength = from.wavelength();
            const double range = 12.05 + 0.1 * draws.whole(150);
            // A tenth of the Fresnel zone.
            const double size = std::sqrt(0.1 * wavelength * range);
            const double wide1 = draws.number(0.5, 1.0) * size;
            const double wide2 = draws.number(0.5, 1.0) * size;
            const double half = 0.5 * draws.number(0.5, 1.0) * size;
            const double angle = draws.number(0.4, 1.1);
            const Mount mount(from.axis, range, {std::cos(angle), std::sin(angle), 0.0},
                              draws.number(0.0, 7.0));
            Scene scene = smooth_scene();
            mount.add(scene, {{0, 0, -half}, {wide1, 0, -half}, {wide1, 0, half}, {0, 0, half}});
            mount.add(scene, {{0, 0, -half}, {0, 0, half}, {0, wide2, half}, {0, wide2, -half}});
            const double area =
                4.0 * half * std::min(wide1 * std::sin(angle), wide2 * std::cos(angle));
            CAPTURE(trial);
            CAPTURE(angle);
            CAPTURE(wide1);
            CAPTURE(wide2);
            CAPTURE(half);
            const double found = peak_db(from, scene, engines_before_shapes[draws.whole(4)], range);
            CHECK(std::fabs(found - far_db(area, reflection * reflection, wavelength, range)) <
                  1.0);
        }
    }

    // Three right triangles of side a, seen along (l, m, n), l <= m <= n: A / a^2 is 4 l m / s, or
    // s - 2 / s if l + m > n, s = l + m + n. On the axis that is 1 / sqrt(3), a cross-section
    // of 4 pi a^4 / (3 lambda^2). Squares have sqrt(3) there.
    TEST_CASE("corners: trihedrals of three triangles and of three squares") {
        CornerDraws draws(26);
        for (int trial = 0; trial < 15; ++trial) {
            const Looking from = looking(kinds_before_shapes[trial % 5], draws.number(1e5, 4e5));
            const double wavelength = from.wavelength();
            const double range = 12.05 + 0.1 * draws.whole(150);
            const double a = draws.number(0.5, 1.0) * std::sqrt(0.1 * wavelength * range);
            const bool squares = trial % 3 == 2;
            Eigen::Vector3d towards = Eigen::Vector3d::Ones();
            // One by one: the order of arguments differs between compilers.
            const double aside = draws.number(0, 1);
            const double up = draws.number(0, 1);
            if (!squares) towards += Eigen::Vector3d(up, aside, 0.0);
            towards.normalize();
            const Mount mount(from.axis, range, towards, draws.number(0.0, 7.0));
            Scene scene = smooth_scene();
            for (int k = 0; k < 3; ++k) {
                const Eigen::Vector3d u = a * Eigen::Vector3d::Unit(k);
                const Eigen::Vector3d v = a * Eigen::Vector3d::Unit((k + 1) % 3);
                const Eigen::Vector3d o = Eigen::Vector3d::Zero();
                mount.add(scene, squares ? std::vector{o, u, Eigen::Vector3d(u + v), v}
                                         : std::vector{o, u, v});
            }
            std::array<double, 3> sines{towards.x(), towards.y(), towards.z()};
            std::ranges::sort(sines);
            const double sum = sines[0] + sines[1] + sines[2];
            const double triangles =
                sines[0] + sines[1] > sines[2] ? sum - 2.0 / sum : 4.0 * sines[0] * sines[1] / sum;
            const double area = a * a * (squares ? std::sqrt(3.0) : triangles);
            const double power = reflection * reflection * reflection;
            CAPTURE(trial);
            CAPTURE(a);
            CAPTURE(wavelength);
            const double found = peak_db(from, scene, engines_before_shapes[draws.whole(4)], range);
            CHECK(std::fabs(found - far_db(area, power, wavelength, range)) < 1.0);
        }
    }

    // Sound that is reflected by each face has the product of their texels' factors. The faces' own
    // side lobes have one factor each and are a tenth of a dB at most.
    TEST_CASE("corners: on faces with maps the texels next to the seam reflect") {
        CornerDraws draws(27);
        for (int trial = 0; trial < 6; ++trial) {
            const Looking from = looking(SonarKind::imaging, draws.number(1e5, 4e5));
            const double range = 12.05 + 0.1 * draws.whole(150);
            const double a = 0.7 * std::sqrt(0.1 * from.wavelength() * range);
            const std::size_t faces = 2 + trial % 2;
            const double roll = draws.number(0.0, 7.0);
            const double factor = draws.number(0.5, 4.0);
            Eigen::Vector3d towards = Eigen::Vector3d::Zero();
            for (std::size_t k = 0; k < faces; ++k)
                towards[static_cast<int>(k)] = 1.0;
            const Mount mount(from.axis, range, towards.normalized(), roll);
            // Face k is an instance of its own. `rough`: the texels of the last face.
            const auto corner_db = [&](std::size_t mapped, bool own_smooth, bool rough) {
                Scene scene = smooth_scene();
                const std::uint32_t other = add_material(scene, reflection);
                const Eigen::Vector3d o = Eigen::Vector3d::Zero();
                const Eigen::Vector3d down = faces == 2 ? Eigen::Vector3d(0.0, 0.0, -0.5 * a) : o;
                for (std::size_t k = 0; k < faces; ++k) {
                    Eigen::Vector3d u = a * Eigen::Vector3d::Unit(static_cast<int>(k));
                    Eigen::Vector3d v = a * Eigen::Vector3d::Unit(static_cast<int>(k + 1) % 3);
                    if (faces == 2) v = Eigen::Vector3d(0.0, 0.0, a);
                    mount.add(scene, {down, down + u, down + u + v, down + v});
                    scene.instances.push_back("face");
                    std::fill_n(scene.triangle_instance.end() - 2, 2,
                                static_cast<std::uint32_t>(k + 1));
                    if (!own_smooth && k < mapped)
                        std::fill_n(scene.triangle_material.end() - 2, 2, other);
                }
                std::vector<char> on(faces + 1, 0);
                for (std::size_t k = 0; k < mapped; ++k)
                    on[k + 1] = 1;
                const TexelFrame frame = square_frame(1, 200.0);
                scene.maps = std::make_shared<const GroundMaps>(
                    material_texels(frame, {rough ? other : 0U},
                                    [](int, int) { return std::uint16_t{0}; }),
                    on, strengths(frame, [&](int, int) { return static_cast<float>(factor); }), on);
                return peak_db(from, scene, EngineKind::slices, range);
            };
            CAPTURE(trial);
            CAPTURE(factor);
            const double plain = corner_db(0, true, false);
            for (std::size_t mapped = 1; mapped <= faces; ++mapped) {
                CAPTURE(mapped);
                const double expected =
                    plain + 10.0 * static_cast<double>(mapped) * std::log10(factor);
                CHECK(std::fabs(corner_db(mapped, true, false) - expected) < 0.2);
                CHECK(std::fabs(corner_db(mapped, false, false) - expected) < 0.2);
                CHECK(corner_db(mapped, true, true) < plain - 10.0);
            }
        }
    }
}
