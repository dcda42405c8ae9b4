#include "simulate/trace/ping_motion.h"

#include "support/draws.h"
#include "support/patches.h"

namespace {

constexpr double sound_m_s = 1500.0;

PingMotion moving(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) {
    return {velocity, turn, sound_m_s};
}

/// Ten beams of 6 degrees.
const View ten_beams{radians(60.0), radians(20.0), 1.0, 100.0, 100, 10};

/// A footprint at 75 m in the middle of each beam, with half of this width, m.
Samples footprints(float half_width_m) {
    Samples samples;
    samples.beam_begin = {0};
    for (int j = 0; j < 10; ++j) {
        const Eigen::Vector3f ahead = direction_of(radians(-27.0 + 6.0 * j), 0.0).cast<float>();
        const Eigen::Vector3f across(-ahead.y(), ahead.x(), 0.0F);
        samples.items.push_back(
            patch_of(75.0F * ahead, -ahead, half_width_m * across, {0.0F, 0.0F, 0.1F}));
        samples.beam_begin.push_back(static_cast<std::uint32_t>(j + 1));
    }
    return samples;
}

}  // namespace

TEST_CASE("ping motion: past a point, sideways") {
    // (c t - d)^2 = d^2 + (v t)^2, so t = 2 c d / (c^2 - v^2), and the point is then v t to the
    // other side. A side-scan sonar has moved half as far between the two patterns.
    const double time = 2.0 * 1500.0 * 60.0 / (1500.0 * 1500.0 - 25.0);
    const PingMotion sideways = moving({0.0, 5.0, 0.0}, {0.0, 0.0, 0.0});
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard}) {
        const Eigen::Vector3d past = measured_place(sideways, shape, {60.0, 0.0, 0.0});
        CHECK(past.norm() == approx(750.0 * time).epsilon(1e-12));
        const double moved_m = (shape == ViewShape::fan ? 5.0 : 2.5) * time;
        CHECK(std::atan2(past.y(), past.x()) == approx(-std::atan(moved_m / 60.0)).epsilon(1e-9));
    }
}

TEST_CASE("ping motion: any motion, by a search for the time of reception; and its inverse") {
    Draws draws(3);
    const auto vector = [&](float size) -> Eigen::Vector3d {
        return (size * draws.in_ball()).cast<double>();
    };
    for (int k = 0; k < 50; ++k) {
        const PingMotion motion = moving(vector(10.0F), vector(0.5F));
        const Eigen::Vector3d place = vector(100.0F);
        double low = 0.0;
        double high = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double t = 0.5 * (low + high);
            const bool early =
                sound_m_s * t < place.norm() + (place - t * motion.velocity_m_s).norm();
            (early ? low : high) = t;
        }
        const Eigen::AngleAxisd turned(low * motion.turn_rad_s.norm(),
                                       motion.turn_rad_s.normalized());
        const Eigen::Vector3d direction =
            (turned.inverse() * (place - low * motion.velocity_m_s)).normalized();
        // A fan has the azimuth of the reception and the elevation of the transmission.
        const Eigen::Vector3d measured = measured_place(motion, ViewShape::fan, place);
        CHECK(measured.norm() == approx(0.5 * sound_m_s * low).epsilon(1e-12));
        CHECK(measured.z() / measured.norm() == approx(place.z() / place.norm()).epsilon(1e-12));
        CHECK(std::fabs(measured.head<2>().normalized().dot(
                  Eigen::Vector2d(direction.y(), -direction.x()).normalized())) < 1e-12);
        for (const ViewShape shape : {ViewShape::fan, ViewShape::cone}) {
            if (shape == ViewShape::fan && std::fabs(place.z()) > 0.8 * place.norm()) continue;
            const Eigen::Vector3d visible = measured_place(motion, shape, place);
            CAPTURE(static_cast<int>(shape));
            CHECK((unmoved_place(motion, shape, visible) - place).norm() < 1e-8);
        }
    }
}

TEST_CASE("ping motion: surface goes to the beam that receives it") {
    // A turn of 6 degrees in the two-way time of 75 m, a tenth of a second.
    Samples samples = footprints(0.1F);
    const Samples before = samples;
    move_in_ping({}, ten_beams, samples);
    CHECK(samples.items[3].position == before.items[3].position);
    move_in_ping(moving({0.0, 0.0, 0.0}, {0.0, 0.0, radians(60.0)}), ten_beams, samples);
    REQUIRE(samples.in_no_beam().size() == 1);
    CHECK(samples.beam(9).empty());
    for (int j = 0; j < 9; ++j) {
        REQUIRE(samples.beam(j).size() == 1);
        const Sample& sample = samples.beam(j)[0];
        CHECK((sample.position - before.items[j].position).norm() < 1e-3F);
        CHECK(sample.height_m == approx(75.0F).epsilon(1e-5));
        CHECK(sample.normal.dot(sample.position) == approx(-75.0F).epsilon(1e-4));
    }
}

TEST_CASE("ping motion: surface that the motion turns across a border is cut there") {
    // Beams of 6 degrees, each filled by one footprint, and a turn of `share` of a beam: beam j
    // holds 1 - share of its own footprint's area and `share` of the next one's. The areas of a
    // wedge's parts are those of a trapezoid, and their centroids together are its own.
    for (const auto& [share, wedge] : {std::pair(0.5F, 0.0F), {0.25F, 0.0F}, {0.25F, 0.4F}}) {
        Samples samples = footprints(75.0F * static_cast<float>(radians(3.0)));
        for (Sample& sample : samples.items) {
            sample.area_m2 = 2.0F;
            sample.wedge = wedge;
        }
        move_in_ping(moving({0.0, 0.0, 0.0}, {0.0, 0.0, radians(60.0 * share)}), ten_beams,
                     samples);
        // The low side of a wedge is the shorter one, and its centroid lies beyond the middle.
        for (int j = 0; j < 9; ++j) {
            REQUIRE(samples.beam(j).size() == 2);
            const auto& [own, next] = std::pair(samples.beam(j)[0], samples.beam(j)[1]);
            if (wedge == 0.0F) {
                CHECK(next.area_m2 == approx(2.0F * share).epsilon(0.01));
                const auto azimuth = std::atan2(next.position.y(), next.position.x());
                CHECK(azimuth ==
                      approx(radians(-30.0 + 6.0 * (j + 1 - share / 2.0))).epsilon(0.01));
            }
            CHECK(beam_of(ten_beams, own.position) == j);
            CHECK(beam_of(ten_beams, next.position) == j);
        }
        for (int j = 1; j < 9; ++j) {  // the parts of one footprint
            const Sample& part = samples.beam(j)[0];
            const Sample& rest = samples.beam(j - 1)[1];
            CHECK(part.area_m2 + rest.area_m2 == approx(2.0F).epsilon(1e-5));
            const Eigen::Vector3f both =
                (part.area_m2 * part.position + rest.area_m2 * rest.position) / 2.0F;
            const auto middle = std::atan2(both.y(), both.x());
            CHECK(std::fabs(middle - radians(-27.0 + 6.0 * (j - share))) < 2e-4);
        }
    }
}
