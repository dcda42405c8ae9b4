#include "simulate/product/object_table.h"
#include "support/calibrated.h"
#include "support/labelled.h"

namespace {

constexpr double turn_deg_s = 40.0;

/// A fan of 60 beams of a degree, in six groups 0.05 s apart, that yaws.
Sonar yawing_camera(ShutterOrder order, double turn) {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.azimuth_deg = 60.0;
    config.azimuth_bins = 60;
    set_range(config, config.range_min_m, 15.0, 300);
    config.moves_in_ping = true;
    config.shutter = {6, order, 0.05};
    Sonar sonar = make_sonar(config, {});
    sonar.motions = std::make_shared<const std::vector<PingMotion>>(
        1, PingMotion{{0.0, 0.0, 0.0}, {0.0, 0.0, radians(turn)}, 1500.0});
    return sonar;
}

/// Half the width of a plate. Rays are 0.5 degrees apart, so that at least one meets a plate.
constexpr double half_plate_deg = 0.4;

/// Plates at 10 m, every 5 degrees from -45 to 45.
Scene plates() {
    Scene scene = empty_scene();
    const std::uint32_t rock = add_material(scene, 0.4F);
    for (int k = -9; k <= 9; ++k) {
        const auto at = [&](double side, float z) -> Eigen::Vector3f {
            const Eigen::Vector3d foot =
                10.0 * direction_of(radians(5.0 * k + half_plate_deg * side), 0.0);
            return foot.cast<float>() + z * Eigen::Vector3f::UnitZ();
        };
        add_quad(scene, at(-1.0, -1.0F), at(1.0, -1.0F), at(1.0, 1.0F), at(-1.0, 1.0F), rock);
    }
    return scene;
}

struct AmongPlates {
    Scene scene = plates();
    SceneObjects objects = group_objects(scene, {});
    std::unique_ptr<VisibilityEngine> engine = make_rays_engine(scene);
};

}  // namespace

// The beam at the azimuth b, of the group g, points at b + w (g P + 2 r / c) of the world: a shear.
// w P is 2 degrees and w 2 r / c 0.533 degrees, so that a beam has all of a plate in it or none.
TEST_CASE_FIXTURE(AmongPlates,
                  "shutter: a fan that yaws shears the picture by its rate times the time") {
    for (const ShutterOrder order : {ShutterOrder::in_turn, ShutterOrder::interleaved}) {
        const Sonar sonar = yawing_camera(order, turn_deg_s);
        const Ping ping = render_ping(sonar, scene, *engine, {}, {.seed = 1}, without_random_terms);
        int bright = 0;
        for (int j = 0; j < 60; ++j) {
            const int group = order == ShutterOrder::in_turn ? j / 10 : j % 6;
            const double middle = j - 29.5 + turn_deg_s * (0.05 * group + 2.0 * 10.0 / 1500.0);
            const double off = std::fabs(middle - 5.0 * std::round(middle / 5.0));
            CAPTURE(j);
            // Beams are one degree wide.
            const bool is_bright = (image_array(ping.intensity, 60).col(j) > 0.0F).any();
            CHECK(is_bright == (off < 0.5 + half_plate_deg));
            bright += is_bright ? 1 : 0;
        }
        CHECK(bright == 12);
    }
}

TEST_CASE_FIXTURE(AmongPlates, "shutter: every label of a beam is that of its group traced alone") {
    LabelRequest request = everything;
    request.outlines = request.height = request.annotations = true;
    for (const ShutterOrder order : {ShutterOrder::in_turn, ShutterOrder::interleaved}) {
        const Sonar sonar = yawing_camera(order, turn_deg_s);
        const TracedPing traced = trace(sonar, scene, *engine, {}, 0);
        const auto labels_of = [&](const TracedPing& ping) {
            return label_ping(ping, sonar.settings, scene, objects, *engine, request);
        };
        const PingLabels whole = labels_of(traced);
        const PingLabels last = labels_of(traced.later_groups.back());
        std::size_t listed = 0;
        for_each_label(request, [&](auto member, bool wanted, auto) {
            ++listed;
            CHECK(wanted);
            REQUIRE((whole.*member).size() == whole.size());
            const std::size_t bins = whole.size() / 60;
            for (std::size_t k = 0; k < 10; ++k) {
                const std::size_t beam = order == ShutterOrder::in_turn ? 50 + k : 6 * k + 5;
                const auto ours = std::span(whole.*member).subspan(beam * bins, bins);
                const auto own = std::span(last.*member).subspan(beam * bins, bins);
                CHECK(std::memcmp(ours.data(), own.data(), ours.size_bytes()) == 0);
            }
        });
        // A list that lacks a label leaves it empty: all vectors, but two found later or by object.
        CHECK(sizeof(PingLabels) == 2 * sizeof(int) + (listed + 2) * sizeof(std::vector<float>));
    }
}

TEST_CASE_FIXTURE(AmongPlates, "shutter: the box of an object lies where its bins do") {
    const Sonar sonar = yawing_camera(ShutterOrder::in_turn, turn_deg_s);
    const TracedPing traced = trace(sonar, scene, *engine, {}, 0);
    const PingLabels labels =
        label_ping(traced, sonar.settings, scene, objects, *engine, everything);
    const Ping ping = form_image(traced, sonar.settings, scene, {});
    const auto visible = visible_objects(sonar, objects, traced, labels, ping, {});
    CHECK(visible.size() == 12);
    for (const ObjectInPing& plate : visible) {
        CAPTURE(plate.id);
        const double azimuth = plate.azimuth_rad.value();
        // Beams are two degrees wide.
        CHECK(std::fabs(plate.box_sensor_m.center().y() - 10.0 * std::sin(azimuth)) < 0.18);
        CHECK(std::fabs(plate.box_sensor_m.center().x() - 10.0 * std::cos(azimuth)) < 0.18);
    }
}

TEST_CASE_FIXTURE(AmongPlates, "shutter: at speed 0 the same bytes as all beams at once") {
    Sonar sonar = yawing_camera(ShutterOrder::in_turn, 0.0);
    const Ping ping = render_ping(sonar, scene, *engine, {}, {.seed = 1});
    sonar.config.shutter = {};
    sonar.motions = nullptr;
    CHECK(render_ping(sonar, scene, *engine, {}, {.seed = 1}).intensity == ping.intensity);
}
