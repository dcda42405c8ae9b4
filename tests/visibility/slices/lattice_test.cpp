#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "support/mean_echoes.h"
#include "support/scenes.h"
#include "validation/reference.h"
#include "visibility/slices/slices_engine.h"

using namespace sonarsim;

namespace {

/// Draws from [low, high), one after the other.
class Draws {
  public:
    explicit Draws(std::uint32_t seed) : seed_(seed) {}

    float operator()(float low, float high) {
        const PhiloxBlock block = philox({next_++, 0, 0, 0}, {seed_, 0x6c617474});
        return low + (high - low) * unit_float(block.x0);
    }
    Eigen::Vector3f point(float size) {
        const float x = (*this)(-size, size);
        const float y = (*this)(-size, size);
        return {x, y, (*this)(-size, size)};
    }

  private:
    std::uint32_t seed_;
    std::uint32_t next_ = 0;
};

/// A member: a square bar from a to b, closed, with its corners shared.
void add_bar(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b, float width,
             std::uint32_t material) {
    const Eigen::Vector3f along = (b - a).normalized();
    const Eigen::Vector3f side = 0.5F * width * along.unitOrthogonal();
    const Eigen::Vector3f up = along.cross(side);
    const std::array<Eigen::Vector3f, 4> ring{side + up, up - side, -side - up, side - up};
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3f& p = ring[k];
        const Eigen::Vector3f& q = ring[(k + 1) % 4];
        shapes::add_quad(scene, a + p, a + q, b + q, b + p, material);
    }
    for (const Eigen::Vector3f& end : {a, b})
        shapes::add_quad(scene, end + ring[0], end + ring[1], end + ring[2], end + ring[3],
                         material);
}

/// A jib of four chords with rungs and diagonals, which points towards the sonar within a few
/// degrees, so that some of its faces are seen nearly along their plane.
void add_jib(Scene& scene, Draws& draw, std::uint32_t material) {
    const Eigen::Vector3f from(draw(8.0F, 14.0F), draw(-3.0F, 3.0F), draw(-1.5F, 1.5F));
    const Eigen::Vector3f to =
        from * draw(1.6F, 2.4F) + Eigen::Vector3f(0.0F, draw(-1.0F, 1.0F), draw(-1.0F, 1.0F));
    const float width = draw(0.05F, 0.3F);
    const Eigen::Vector3f along = (to - from).normalized();
    const Eigen::Vector3f side = draw(0.3F, 1.0F) * along.cross(draw.point(1.0F)).normalized();
    const Eigen::Vector3f up = along.cross(side);
    const std::array<Eigen::Vector3f, 4> chords{side + up, up - side, -side - up, side - up};
    constexpr int bays = 6;
    for (int k = 0; k < 4; ++k) {
        add_bar(scene, from + chords[k], to + chords[k], width, material);
        for (int i = 0; i <= bays; ++i) {
            const Eigen::Vector3f at = from + (to - from) * (static_cast<float>(i) / bays);
            const Eigen::Vector3f next = from + (to - from) * (static_cast<float>(i + 1) / bays);
            const Eigen::Vector3f& beside = chords[(k + 1) % 4];
            add_bar(scene, at + chords[k], at + beside, 0.6F * width, material);
            if (i < bays) add_bar(scene, at + chords[k], next + beside, 0.6F * width, material);
        }
    }
}

/// A ladder: two rails and rungs, any way round.
void add_ladder(Scene& scene, Draws& draw, std::uint32_t material) {
    const Eigen::Vector3f from(draw(6.0F, 20.0F), draw(-5.0F, 5.0F), draw(-2.0F, 2.0F));
    const Eigen::Vector3f along = draw(3.0F, 9.0F) * draw.point(1.0F).normalized();
    const Eigen::Vector3f across = 0.5F * along.cross(draw.point(1.0F)).normalized();
    const float width = draw(0.03F, 0.15F);
    add_bar(scene, from, from + along, width, material);
    add_bar(scene, from + across, from + along + across, width, material);
    for (int i = 1; i < 10; ++i) {
        const Eigen::Vector3f at = from + 0.1F * static_cast<float>(i) * along;
        add_bar(scene, at, at + across, 0.7F * width, material);
    }
}

/// A net of thin bars in a plane, any way round.
void add_net(Scene& scene, Draws& draw, std::uint32_t material) {
    const Eigen::Vector3f from(draw(6.0F, 20.0F), draw(-5.0F, 5.0F), draw(-2.0F, 2.0F));
    const Eigen::Vector3f a = draw(2.0F, 5.0F) * draw.point(1.0F).normalized();
    const Eigen::Vector3f b = draw(2.0F, 5.0F) * a.cross(draw.point(1.0F)).normalized();
    const float width = draw(0.01F, 0.05F);
    constexpr int meshes = 8;
    for (int i = 0; i <= meshes; ++i) {
        const float share = static_cast<float>(i) / meshes;
        add_bar(scene, from + share * a, from + share * a + b, width, material);
        add_bar(scene, from + share * b, from + share * b + a, width, material);
    }
}

/// Many-sided tapered stays that hang upright in the picture and end in view, so that slices run
/// nearly along some of their faces. Every face is an instance of its own. Appends their areas,
/// m^2.
void add_stays(Scene& scene, Draws& draw, int count, std::uint32_t material,
               std::vector<float>& areas) {
    for (int k = 0; k < count; ++k) {
        const float azimuth = draw(-0.45F, 0.45F);
        const Eigen::Vector3f ahead(std::cos(azimuth), std::sin(azimuth), 0.0F);
        const float near = draw(20.0F, 40.0F);
        const float far = near * draw(1.2F, 2.0F);
        const Eigen::Vector3f foot = near * (ahead - draw(0.05F, 0.3F) * Eigen::Vector3f::UnitZ());
        const Eigen::Vector3f top = far * (ahead + draw(0.05F, 0.2F) * Eigen::Vector3f::UnitZ() +
                                           draw(-3e-4F, 3e-4F) * Eigen::Vector3f::UnitY());
        const float radius = draw(0.01F, 0.2F);
        const float taper = draw(0.3F, 1.0F);
        const int sides = 6 + static_cast<int>(draw(0.0F, 20.0F));
        const float turn = draw(0.0F, 6.28F);
        const Eigen::Vector3f along = (top - foot).normalized();
        const Eigen::Vector3f side = along.unitOrthogonal();
        const auto around = [&](int i) {
            const float angle = turn + 2.0F * static_cast<float>(pi) *
                                           static_cast<float>(i % sides) /
                                           static_cast<float>(sides);
            return Eigen::Vector3f(radius *
                                   (std::cos(angle) * side + std::sin(angle) * along.cross(side)));
        };
        for (int i = 0; i < sides; ++i) {
            const Eigen::Vector3f a = foot + around(i);
            const Eigen::Vector3f b = foot + around(i + 1);
            const Eigen::Vector3f c = top + taper * around(i + 1);
            const Eigen::Vector3f d = top + taper * around(i);
            shapes::add_quad(scene, a, b, c, d, material);
            areas.push_back(0.5F * (c - a).cross(d - b).norm());
        }
    }
}

Scene lattices(std::uint32_t seed) {
    Scene scene = shapes::empty_scene();
    const std::uint32_t steel = shapes::add_material(scene, 0.8F);
    Draws draw(seed);
    add_jib(scene, draw, steel);
    add_ladder(scene, draw, steel);
    add_net(scene, draw, steel);
    return scene;
}

View lattice_view() {
    return {.azimuth_rad = radians(60.0),
            .elevation_rad = radians(30.0),
            .range_min_m = 1.0,
            .range_max_m = 40.0,
            .range_bins = 256,
            .beams = 128,
            .relative_l1 = 0.01};
}

/// The largest share of its light by which a beam is off. A dim beam counts as one that is as
/// bright as the mean; beams of few bins are left out, where a sliver in another bin decides.
double worst_beam(const std::vector<double>& image, const std::vector<double>& truth,
                  const View& view) {
    double whole = 0.0;
    for (const double intensity : truth)
        whole += intensity;
    double worst = 0.0;
    for (int j = 0; j < view.beams; ++j) {
        double apart = 0.0;
        double sum = 0.0;
        int occupied = 0;
        for (int i = 0; i < view.range_bins; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * view.range_bins + i;
            apart += std::fabs(image[k] - truth[k]);
            sum += truth[k];
            occupied += truth[k] > 0.0 ? 1 : 0;
        }
        if (occupied >= 16) worst = std::max(worst, apart / std::max(sum, whole / view.beams));
    }
    return worst;
}

std::vector<double> brute_force(const Scene& scene, const View& view) {
    const Reference reference =
        cast_reference(Caster(scene), scene, view, Pose{}, {0.02, 64.0, 4'000'000});
    std::vector<double> by_beam(reference.intensity.size());
    for (int j = 0; j < view.beams; ++j) {
        for (int i = 0; i < view.range_bins; ++i) {
            by_beam[static_cast<std::size_t>(j) * view.range_bins + i] =
                reference.intensity[static_cast<std::size_t>(i) * view.beams + j];
        }
    }
    return by_beam;
}

}  // namespace

TEST_SUITE_BEGIN("slices");

// Corners that were moved off their plane made faces of 0.2 m^2 count for 37 m^2. What remains is
// that a face that a slice meets counts for the slice's whole strip where the surface goes on with
// the next face: of a face at the limb, some 40 times its area.
TEST_CASE("slices: no face of a stay stands for many times its area") {
    View view = lattice_view();
    view.range_max_m = 80.0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        Scene scene = shapes::empty_scene();
        Draws draw(seed);
        std::vector<float> areas;
        add_stays(scene, draw, 200, shapes::add_material(scene, 0.8F), areas);
        const auto engine = make_slices_engine(scene, Caster(scene));
        for (const double goal : {0.03, 0.01, 0.004}) {
            view.relative_l1 = goal;
            std::vector<float> seen(areas.size(), 0.0F);
            for (const Sample& sample : engine->visible_surface(view, Pose{}).items)
                seen[sample.instance] += sample.area_m2;
            float most = 0.0F;
            for (std::size_t k = 0; k < areas.size(); ++k)
                most = std::max(most, seen[k] / areas[k]);
            CAPTURE(seed);
            CAPTURE(goal);
            CHECK(most < 60.0F);
        }
    }
}

TEST_CASE("slices: no beam of a drawn lattice is far from brute force at any goal") {
    View view = lattice_view();
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Scene scene = lattices(seed);
        const std::vector<double> truth = brute_force(scene, view);
        const auto engine = make_slices_engine(scene, Caster(scene));
        for (const double goal : {0.03, 0.02, 0.01, 0.006, 0.003}) {
            view.relative_l1 = goal;
            const Samples samples = engine->visible_surface(view, Pose{});
            CAPTURE(seed);
            CAPTURE(goal);
            CHECK(worst_beam(test::mean_echoes(scene, view, samples), truth, view) < 0.5);
        }
    }
}

TEST_SUITE_END();
