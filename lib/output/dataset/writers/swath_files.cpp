#include <cmath>

#include "core/pose.h"
#include "core/units.h"
#include "output/dataset/map_place.h"
#include "output/dataset/writer.h"
#include "output/format/xtf.h"
#include "simulate/assembly/poses.h"
#include "simulate/product/contrast.h"
#include "simulate/product/sidescan.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

struct RecordedRow {
    std::uint32_t pose;
    Pose T_world_sensor;
    std::span<const float> values;
    std::optional<Swath> swath;
};

void for_each_row(const WriterContext& context, const VisibilityEngine& engine,
                  const RecordFile& rows, const std::function<void(const RecordedRow&)>& visit) {
    const Sonar& sonar = context.sonar();
    std::vector<float> values(rows.record_bytes() / sizeof(float));
    for (std::size_t k = 0; k < rows.records(); ++k) {
        rows.read(k, std::as_writable_bytes(std::span(values)));
        const auto pose = static_cast<std::uint32_t>(k * sonar.config.every);
        const SonarAtPose then(context.mission, sonar, pose);
        const Pose T_world_sensor =
            sensor_pose(*then, context.assembly.trajectory[pose].T_world_vehicle, pose);
        const auto now =
            engine_at(engine, context.assembly.motions, context.assembly.trajectory[pose].t_s);
        visit({pose, T_world_sensor, values,
               swath_of(sonar, T_world_sensor,
                        measured_altitude_m(context.assembly.scene, *now, T_world_sensor))});
    }
}

/// Attitude of the body of a sonar that looks down; its channels are port and starboard of it.
Rpy body_attitude(const Pose& T_world_sensor) {
    return rpy_from_rotation(T_world_sensor.rotation * rotation_from_rpy(0.0, -0.5 * pi, 0.0));
}

double heading_deg(const Rpy& attitude) {
    return std::fmod(450.0 - degrees(attitude.yaw), 360.0);
}

XtfPing xtf_ping(const WriterContext& context, const RecordedRow& row) {
    const SonarConfig& config = context.sonar().config;
    const Trajectory& trajectory = context.assembly.trajectory;
    const Rpy attitude = body_attitude(row.T_world_sensor);
    const Eigen::Vector3d& position = row.T_world_sensor.translation;
    const auto place_of = [&](const TimedPose& pose) -> Eigen::Vector2d {
        return map_origin(context.mission) + pose.T_world_vehicle.translation.head<2>();
    };
    // The last ping has the interval before it.
    const auto every = static_cast<std::size_t>(config.every);
    const bool is_last = row.pose + every >= trajectory.size();
    const TimedPose& from = trajectory[is_last && row.pose >= every ? row.pose - every : row.pose];
    const TimedPose& to = trajectory[is_last ? row.pose : row.pose + every];
    const double interval_s = to.t_s - from.t_s;
    const auto& surface = context.mission.scene.water_surface;
    return {
        .number = row.pose,
        .t_s = trajectory[row.pose].t_s,
        .ship_m = place_of(trajectory[row.pose]),
        .sensor_m = map_origin(context.mission) + position.head<2>(),
        .speed_m_s = interval_s > 0.0 ? (place_of(to) - place_of(from)).norm() / interval_s : 0.0,
        .depth_m = (surface ? surface->height_m : 0.0) - position.z(),
        .altitude_m = row.swath ? row.swath->altitude_m : 0.0,
        .heading_deg = heading_deg(attitude),
        .ship_heading_deg =
            heading_deg(rpy_from_rotation(trajectory[row.pose].T_world_vehicle.rotation)),
        .pitch_deg = -degrees(attitude.pitch),
        .roll_deg = degrees(attitude.roll),
        .sound_speed_m_s = context.mission.water.sound_speed_m_s,
        .range_max_m = config.range_max_m,
        .seconds_per_ping = interval_s};
}

/// The sonar as an XTF file describes it. In the paper's model a side receives all of its sector.
XtfFile xtf_file(const SonarConfig& config) {
    XtfFile file{.sonar_name = config.name,
                 .beam_width_deg = static_cast<float>(config.elevation_deg),
                 .across_width_deg = static_cast<float>(config.azimuth_deg / 2.0)};
    if (config.model == ModelKind::calibrated) {
        const BeamConfig& beam = config.instrument.beam;
        file.frequency_khz = static_cast<float>(config.instrument.frequency_hz / 1000.0);
        file.beam_width_deg = static_cast<float>(beam.width_deg);
        file.across_width_deg = static_cast<float>(beam.across_width_deg);
        file.tilt_deg = static_cast<float>(beam.tilt_deg);
    }
    return file;
}

void write_xtf(const WriterContext& context, const VisibilityEngine& engine, const RecordFile& rows,
               const std::filesystem::path& folder) {
    const XtfFile sonar = xtf_file(context.sonar().config);
    StreamedFile file(folder / "waterfall.xtf");
    file.append(xtf_header(sonar));
    for_each_row(context, engine, rows, [&](const RecordedRow& row) {
        file.append(
            xtf_record(sonar, xtf_ping(context, row), grey_16(row.values, context.full_scale())));
    });
    file.finish();
}

/// The cell size: neighbouring pings and bins leave no cell between them empty.
double mosaic_cell_m(const WriterContext& context) {
    const Trajectory& trajectory = context.assembly.trajectory;
    const auto every = static_cast<std::size_t>(context.sonar().config.every);
    const double bin_m = context.sonar().settings.view.bin_m();
    std::vector<double> steps_m;
    for (std::size_t k = every; k < trajectory.size(); k += every) {
        const double step_m = (trajectory[k].T_world_vehicle.translation -
                               trajectory[k - every].T_world_vehicle.translation)
                                  .norm();
        if (step_m > 0.1 * bin_m) steps_m.push_back(step_m);
    }
    // The median of the steps that move: a trajectory may have gaps and waits.
    if (steps_m.empty()) return round_up_125(bin_m);
    const auto middle = steps_m.begin() + std::ssize(steps_m) / 2;
    std::ranges::nth_element(steps_m, middle);
    return round_up_125(std::max(1.2 * *middle, bin_m));
}

void write_mosaic(const WriterContext& context, const VisibilityEngine& engine,
                  const RecordFile& rows, const std::filesystem::path& folder) {
    GroundBounds bounds;
    std::uint64_t dark = 0;
    for_each_row(context, engine, rows, [&](const RecordedRow& row) {
        row.swath ? add_bounds(*row.swath, bounds) : void(++dark);
    });
    GroundGrid mosaic = make_ground_grid(bounds, mosaic_cell_m(context));
    std::optional<SwathRow> before;
    for_each_row(context, engine, rows, [&](const RecordedRow& row) {
        if (!row.swath) return before.reset();
        SwathRow now{*row.swath, {row.values.begin(), row.values.end()}};
        add_between(context.sonar(), before ? *before : now, now, mosaic);
        before = std::move(now);
    });
    write_map(context, folder, "mosaic", mosaic, mosaic.mean(),
              {{"file", "mosaic.tif"},
               {"values", "weighted mean of the echoes in a cell; NaN where there are none"},
               {"weight", "4 u (1 - u) of the ground at the share u of a swath's reach"},
               {"interpolation", "linear between pings"}},
              {{"ground", "level, at the altitude of each ping"},
               {"pings", rows.records() - dark},
               {"pings_left_out", dark}});
}

}  // namespace

std::vector<std::string> swath_products(const WriterContext& context) {
    std::vector<std::string> products;
    if (context.mission.output.xtf) products = {"waterfall.xtf"};
    if (context.mission.output.mosaic)
        products.insert(products.end(), {"mosaic.tif", "mosaic.json"});
    return products;
}

void write_swath_files(const WriterContext& context, const RecordFile& rows,
                       const std::filesystem::path& folder) {
    if (swath_products(context).empty()) return;
    const auto engine = make_engine(context.mission, context.assembly);
    if (context.mission.output.xtf) write_xtf(context, *engine, rows, folder);
    if (context.mission.output.mosaic) write_mosaic(context, *engine, rows, folder);
}

}  // namespace sonarsim
