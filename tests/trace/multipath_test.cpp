#include "simulate/trace/multipath.h"

#include "simulate/paper/echoes.h"
#include "simulate/sonar/sonar.h"
#include "support/bounces.h"
#include "support/patches.h"

namespace {

/// The expected echo of a sample at p_i, from the scene's geometry; none if it is not positive.
struct Expected {
    double range;
    double azimuth;
    double intensity;
};

double beam_of_azimuth(const View& view, double azimuth) {
    return (azimuth / view.azimuth_rad + 0.5) * view.beams;
}

/// Each bounce lies where the geometry says, and so do points nearby on its footprint.
void check_against(const Found& found, const View& view,
                   const std::function<Expected(const Eigen::Vector3d&)>& geometry) {
    for (const BouncePath& b : found.bounces) {
        const Sample& sample = found.samples.items[b.sample];
        const Eigen::Vector3d at = sample.position.cast<double>();
        const Expected truth = geometry(at);
        CHECK(std::fabs(b.range_m - truth.range) < 1e-4);
        CHECK(std::fabs(b.beam - beam_of_azimuth(view, truth.azimuth)) < 1e-2);
        CHECK(std::fabs(b.intensity - truth.intensity) < 1e-4);
        constexpr double step = 1e-3;
        const auto edge = [&](const Eigen::Vector3f& half, float range_change, float beam_change) {
            // Beside an edge of the scene a footprint may stick out of the plane a little.
            if (std::fabs(half.dot(sample.normal)) > 1e-5F) return;
            const Expected ahead = geometry(at + step * half.cast<double>());
            const Expected behind = geometry(at - step * half.cast<double>());
            CHECK(std::fabs(range_change - (ahead.range - behind.range) / (2.0 * step)) < 1e-4);
            CHECK(std::fabs(beam_change - (beam_of_azimuth(view, ahead.azimuth) -
                                           beam_of_azimuth(view, behind.azimuth)) /
                                              (2.0 * step)) < 1e-3);
        };
        edge(sample.edge_u, b.range_u, b.beam_u);
        edge(sample.edge_v, b.range_v, b.beam_v);
    }
}

}  // namespace

TEST_CASE("multipath between two perpendicular walls") {
    // Walls y = a and x = b. Mirrored in the first, the sonar is at s = (0, 2a, 0); the line from
    // there through p_i = (x, a, z) meets x = b at p = s + (b / x) (p_i - s), which turns the x of
    // its direction. The other way round the same with x and y exchanged.
    constexpr double a = 2.0;
    constexpr double b = 5.0;
    Scene scene = rectangle_scene({0, a, -3}, {b, a, 3}, 0.5F);
    add_rectangle(scene, {b, -9, -3}, {b, a, 3}, add_material(scene, 0.8F));
    const View view = fan(100.0, 12.0);
    const auto is_on_port = [](const Eigen::Vector3d& at) { return at.x() < b - 1e-3; };
    const auto image_source = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        return is_on_port(at) ? Eigen::Vector3d(0, 2 * a, 0) : Eigen::Vector3d(2 * b, 0, 0);
    };
    const auto second_point = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
        const double t = is_on_port(at) ? b / at.x() : a / at.y();
        return image_source(at) + t * (at - image_source(at));
    };
    const auto geometry = [&](const Eigen::Vector3d& at) -> Expected {
        const Eigen::Vector3d out = at - image_source(at);
        const double turn = is_on_port(at) ? -1.0 : 1.0;
        const Eigen::Vector3d p = second_point(at);
        const Eigen::Vector3d q(turn * out.x(), -turn * out.y(), out.z());  // from p on
        return {0.5 * ((p - image_source(at)).norm() + p.norm()), std::atan2(p.y(), p.x()),
                -0.5 * 0.8 * q.normalized().dot(p.normalized())};
    };
    for (const int epsilon : {0, 5}) {
        const Found found = find(scene, view, clusters_of(epsilon));
        check_against(found, view, geometry);
        // Every sample whose path geometry closes has come back, except next to an edge.
        std::size_t closed = 0;
        for (const Sample& sample : found.samples.items) {
            const Eigen::Vector3d at = sample.position.cast<double>();
            const Eigen::Vector3d p = second_point(at);
            const bool onwards = is_on_port(at) || (at.y() > 0.0 && at.y() < a);
            const bool on_wall =
                onwards && std::fabs(p.z()) < 3.0 &&
                (is_on_port(at) ? p.y() > -9.0 && p.y() < a : p.x() > 0.0 && p.x() < b);
            const Expected e = geometry(at);
            const bool visible =
                std::fabs(std::asin(p.z() / p.norm())) < 0.5 * view.elevation_rad &&
                std::fabs(e.azimuth) < 0.5 * view.azimuth_rad;
            closed += on_wall && visible && e.intensity > 0.0 && e.range < view.range_max_m;
        }
        REQUIRE(closed > 300);
        CHECK(static_cast<double>(found.bounces.size()) ==
              approx(static_cast<double>(closed)).epsilon(0.02));
    }
}

TEST_CASE("a wall behind the field of view contributes nothing") {
    Scene scene = rectangle_scene({4, -9, -9}, {4, 9, 9}, 0.6F);
    add_rectangle(scene, {-2, -90, -90}, {-2, 90, 90}, 0);
    const Found found = find(scene, fan(60.0, 12.0), clusters_of(5));
    CHECK(found.bounces.empty());
    CHECK(found.counts.outside == found.counts.samples);
}

TEST_CASE("every sample is counted once") {
    const Scene scene = tank();
    for (const int epsilon : {0, 1, 5, 9}) {
        const Found found = find(scene, fan(60.0, 12.0), clusters_of(epsilon), tank_poses()[0]);
        const MultipathCounts& n = found.counts;
        CHECK(n.bounces == found.bounces.size());
        CHECK(n.samples ==
              n.bounces + n.missed + n.edge_on + n.behind + n.outside + n.turned_away + n.hidden);
        CHECK(n.clusters <= n.samples);
    }
}

TEST_CASE("a footprint wider than a beam lights all beams that it covers, over a seam as well") {
    for (const double azimuth_deg : {60.0, 360.0}) {
        const View view = fan(azimuth_deg, 12.0);
        const bool seam = azimuth_deg > 180.0;
        Samples samples;
        samples.items.push_back(point_facing({seam ? -1.0F : 1.0F, 0.0F, 0.0F}, 2.0));
        // Its beams: 3.4 to either side.
        BouncePath bounce;
        bounce.sample = 0;
        bounce.range_m = 5.0F;
        bounce.range_u = 0.1F;
        bounce.range_v = 0.02F;
        bounce.beam = seam ? 0.5F : 20.5F;
        bounce.beam_u = 3.4F;
        bounce.intensity = 0.7F;
        const MultipathEchoes out = multipath_echoes({&bounce, 1}, samples, view, {});
        float weight = 0.0F;
        for (int j = 0; j < view.beams; ++j) {
            const bool lit = seam ? j <= 3 || j >= view.beams - 3 : j >= 17 && j <= 23;
            CHECK((out.beam_begin[j + 1] > out.beam_begin[j]) == lit);
            for (std::uint32_t k = out.beam_begin[j]; k < out.beam_begin[j + 1]; ++k) {
                weight += out.echoes.weight[k];
                if (!seam)
                    CHECK(out.echoes.range_m[k] ==
                          approx(5.0 + 0.1 * (j - 20) / 3.4).epsilon(0.002));
            }
        }
        CHECK(weight == approx(2.0));
    }
}
