#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/build_info.h"
#include "core/file.h"
#include "core/pose.h"
#include "core/units.h"
#include "output/dataset/map_place.h"
#include "output/dataset/writer.h"
#include "simulate/product/contrast.h"
#include "simulate/product/mosaic.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

Pose pose_of_sensor(const WriterContext& context, std::size_t pose) {
    const auto number = static_cast<std::uint32_t>(pose);
    const SonarAtPose then(context.mission, context.sonar(), number);
    return sensor_pose(*then, context.assembly.trajectory[pose].T_world_vehicle, number);
}

struct RecordedRow {
    std::size_t pose;
    Pose T_world_sensor;
    std::span<const float> values;
    std::optional<Swath> swath;
};

void for_each_row(const WriterContext& context, const RecordFile& rows,
                  const std::function<void(const RecordedRow&)>& visit) {
    const Sonar& sonar = context.sonar();
    std::vector<float> values(rows.record_bytes() / sizeof(float));
    for (std::size_t k = 0; k < rows.records(); ++k) {
        rows.read(k, std::as_writable_bytes(std::span(values)));
        const std::size_t pose = k * static_cast<std::size_t>(sonar.config.every);
        const Pose T_world_sensor = pose_of_sensor(context, pose);
        visit({pose, T_world_sensor, values, swath_of(sonar, T_world_sensor, values)});
    }
}

/// Heading, pitch and roll of the body of a sonar that looks down: those of the vehicle, turned by
/// the mount. Its channels are port and starboard of this heading.
Rpy body_attitude(const Pose& T_world_sensor) {
    return rpy_from_rotation(T_world_sensor.rotation * rotation_from_rpy(0.0, -0.5 * pi, 0.0));
}

// XTF, the eXtended Triton Format of side-scan data: Triton Imaging, "eXtended Triton Format (XTF)
// Rev. 40". Two channels, port and starboard, of 16 bits; positions in metres. The world's frame is
// the grid: x east, y north.

static_assert(std::endian::native == std::endian::little, "XTF is little-endian");

constexpr std::size_t file_header_bytes = 1024;
constexpr std::size_t channels_at = 256;  ///< offset in the file's header
constexpr std::size_t channel_bytes = 128;
constexpr std::size_t ping_header_bytes = 256;
constexpr std::size_t channel_header_bytes = 64;
constexpr std::size_t record_unit = 64;  ///< the size of a record is a multiple of it

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(&bytes[at], &value, sizeof value);
}

/// Writes a text and a zero byte.
void put_text(std::string& bytes, std::size_t at, std::string_view text, std::size_t room) {
    std::memcpy(&bytes[at], text.data(), std::min(text.size(), room - 1));
}

void put_float(std::string& record, std::size_t at, double value) {
    put(record, at, static_cast<float>(value));
}

void put_channel(std::string& header, std::uint8_t type, const SonarConfig& config) {
    constexpr std::uint8_t two_byte_integer = 3;
    const bool port = type == 1;
    const std::size_t at = channels_at + (port ? 0 : channel_bytes);
    put<std::uint8_t>(header, at, type);
    put<std::uint16_t>(header, at + 2, 1);  // slant range
    put<std::uint16_t>(header, at + 4, 1);  // unipolar
    put<std::uint16_t>(header, at + 6, 2);  // bytes per sample
    put_text(header, at + 12, port ? "Port" : "Starboard", 16);
    put_float(header, at + 36, config.azimuth_deg / 2.0);  // half of the swath
    put_float(header, at + 44, config.elevation_deg);      // beamwidth along track
    put<std::uint8_t>(header, at + 74, two_byte_integer);
}

/// The header of the file.
std::string xtf_header(const SonarConfig& config) {
    std::string header(file_header_bytes, '\0');
    put<std::uint8_t>(header, 0, 0x7B);
    put<std::uint8_t>(header, 1, 1);
    put_text(header, 2, "sonarsim", 9);
    put_text(header, 10, build_info().version, 8);
    put_text(header, 18, config.name, 16);
    put<std::uint16_t>(header, 164, 0);  // positions in metres
    put<std::uint16_t>(header, 166, 2);  // channels of a sonar
    put_channel(header, 1, config);
    put_channel(header, 2, config);
    return header;
}

/// Writes the date and time of day to the fields from byte 14 on.
void put_time(std::string& record, double t_s) {
    using namespace std::chrono;
    const auto hundredths = static_cast<std::int64_t>(std::floor(t_s * 100.0));
    const sys_time<duration<std::int64_t, std::centi>> time{
        duration<std::int64_t, std::centi>(hundredths)};
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    const auto day_of_year = (day - sys_days(date.year() / January / 1)).count() + 1;
    put(record, 14, static_cast<std::uint16_t>(static_cast<int>(date.year())));
    put(record, 16, static_cast<std::uint8_t>(static_cast<unsigned>(date.month())));
    put(record, 17, static_cast<std::uint8_t>(static_cast<unsigned>(date.day())));
    put(record, 18, static_cast<std::uint8_t>(clock.hours().count()));
    put(record, 19, static_cast<std::uint8_t>(clock.minutes().count()));
    put(record, 20, static_cast<std::uint8_t>(clock.seconds().count()));
    put(record, 21, static_cast<std::uint8_t>(clock.subseconds().count()));
    put(record, 22, static_cast<std::uint16_t>(day_of_year));
}

/// Writes the place of the sonar and its attitude. The heading is clockwise from y, the pitch bow
/// up and the roll starboard down; the depth is that below z = 0.
void put_pose(std::string& record, const Eigen::Vector2d& map_origin_m,
              const Pose& T_world_sensor) {
    const Rpy attitude = body_attitude(T_world_sensor);
    const Eigen::Vector3d& position = T_world_sensor.translation;
    const Eigen::Vector2d on_map = map_origin_m + position.head<2>();
    for (const std::size_t at : {128, 160}) {
        put(record, at, on_map.y());
        put(record, at + 8, on_map.x());
    }
    put_float(record, 192, -position.z());
    put_float(record, 204, -degrees(attitude.pitch));
    put_float(record, 208, degrees(attitude.roll));
    for (const std::size_t at : {124, 212, 220})
        put_float(record, at, std::fmod(450.0 - degrees(attitude.yaw), 360.0));
}

/// The record of one ping. The values of a row are port from range_max to nadir, then starboard
/// from nadir on. The port channel keeps that order, as is usual in XTF: its last sample is at
/// nadir.
std::string xtf_record(const WriterContext& context, const RecordedRow& row) {
    const SonarConfig& config = context.sonar().config;
    const Trajectory& trajectory = context.assembly.trajectory;
    const std::vector<std::uint16_t> grey = grey_16(row.values, context.full_scale());
    const std::size_t bytes = ping_header_bytes + 2 * (channel_header_bytes + grey.size());
    std::string record((bytes + record_unit - 1) / record_unit * record_unit, '\0');
    const double sound_speed_m_s = context.mission.water.sound_speed_m_s;
    const double altitude_m = row.swath ? row.swath->altitude_m : 0.0;  // 0: no bottom is seen
    put<std::uint16_t>(record, 0, 0xFACE);
    put<std::uint16_t>(record, 4, 2);  // channels that follow
    put(record, 10, static_cast<std::uint32_t>(record.size()));
    put_time(record, trajectory[row.pose].t_s);
    put(record, 28, static_cast<std::uint32_t>(row.pose));
    put_float(record, 32, sound_speed_m_s / 2.0);  // XTF has half the speed, for two-way time
    put_float(record, 72, sound_speed_m_s);
    put_float(record, 196, altitude_m);
    put_pose(record, map_origin(context.mission), row.T_world_sensor);

    const std::size_t next = row.pose + static_cast<std::size_t>(config.every);
    const double seconds_per_ping =
        next < trajectory.size() ? trajectory[next].t_s - trajectory[row.pose].t_s : 0.0;
    const double range_m = config.range_max_m;
    const std::size_t samples = grey.size() / 2;
    std::size_t at = ping_header_bytes;
    for (const std::uint16_t channel : {0, 1}) {
        put(record, at, channel);
        put_float(record, at + 4, range_m);
        put_float(record, at + 8,
                  std::sqrt(std::max(0.0, range_m * range_m - altitude_m * altitude_m)));
        put_float(record, at + 16, 2.0 * range_m / sound_speed_m_s);
        put_float(record, at + 20, seconds_per_ping);
        put(record, at + 42, static_cast<std::uint32_t>(samples));
        at += channel_header_bytes;
        std::memcpy(&record[at], grey.data() + channel * samples, 2 * samples);
        at += 2 * samples;
    }
    return record;
}

void write_xtf(const WriterContext& context, const RecordFile& rows,
               const std::filesystem::path& folder) {
    StreamedFile file(folder / "waterfall.xtf");
    file.append(xtf_header(context.sonar().config));
    for_each_row(context, rows,
                 [&](const RecordedRow& row) { file.append(xtf_record(context, row)); });
    file.finish();
}

/// The cell size: neighbouring pings and bins leave no cell between them empty.
double mosaic_cell_m(const WriterContext& context) {
    const Trajectory& trajectory = context.assembly.trajectory;
    double way_m = 0.0;
    for (std::size_t k = 1; k < trajectory.size(); ++k) {
        way_m += (trajectory[k].T_world_vehicle.translation -
                  trajectory[k - 1].T_world_vehicle.translation)
                     .norm();
    }
    const std::size_t pings = count_pings(context.mission, trajectory.size()).at(context.sensor);
    const double spacing_m = way_m / static_cast<double>(std::max<std::size_t>(1, pings));
    return round_up_125(std::max(1.2 * spacing_m, context.sonar().settings.view.bin_m()));
}

void write_mosaic(const WriterContext& context, const RecordFile& rows,
                  const std::filesystem::path& folder) {
    SoundingBounds bounds;
    std::uint64_t dark = 0;
    for_each_row(context, rows, [&](const RecordedRow& row) {
        row.swath ? add_bounds(*row.swath, bounds) : void(++dark);
    });
    Mosaic mosaic(make_bathymetry(bounds, mosaic_cell_m(context)));
    std::optional<SwathRow> before;
    for_each_row(context, rows, [&](const RecordedRow& row) {
        if (!row.swath) return before.reset();
        SwathRow now{*row.swath, {row.values.begin(), row.values.end()}};
        add_between(context.sonar(), before ? *before : now, now, mosaic);
        before = std::move(now);
    });
    write_map(context, folder, "mosaic", mosaic.grid, mosaic.mean(),
              {{"file", "mosaic.tif"},
               {"values", "weighted mean of the echoes in a cell; NaN where there are none"},
               {"weight", "4 u (1 - u) of the ground at the share u of a swath's reach"},
               {"interpolation", "linear between pings"}},
              {{"ground", "level, at the first return of each ping"},
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
    if (context.mission.output.xtf) write_xtf(context, rows, folder);
    if (context.mission.output.mosaic) write_mosaic(context, rows, folder);
}

}  // namespace sonarsim
