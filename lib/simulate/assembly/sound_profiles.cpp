#include "simulate/assembly/sound_profiles.h"

#include <cmath>
#include <memory>

#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 24;

/// The speed of sound at a depth below scene.water_surface.
struct ProfilePoint {
    double depth_m;
    double sound_speed_m_s;
};

/// The temperature of the water at a depth.
struct Temperature {
    double depth_m;
    double celsius;
};

// Chosen values: a mixed layer over a thermocline, of 50 m for mid latitudes in winter, of 8 m for
// a shelf sea in August. Below 100 m only the pressure changes.
std::vector<Temperature> temperatures(NamedProfile named, double celsius) {
    constexpr double deepest_m = 8000.0;
    switch (named) {
        case NamedProfile::mixed_layer: {
            const double below = std::max(celsius - 6.0, std::min(celsius, 0.0));
            return {{0.0, celsius}, {50.0, celsius}, {100.0, below}, {deepest_m, below}};
        }
        case NamedProfile::summer:
            return {{0.0, 20.0}, {8.0, 20.0}, {30.0, 8.0}, {deepest_m, 8.0}};
        default:
            return {{0.0, celsius}, {deepest_m, celsius}};
    }
}

/// The speed is not linear in temperature; nodes at this distance keep the error below 0.02 m/s.
constexpr double thermocline_step_m = 2.0;
constexpr double deep_step_m = 500.0;

std::vector<ProfilePoint> named_points(const SoundProfileConfig& config, WaterConfig water) {
    const std::vector<Temperature> nodes = temperatures(config.named, water.temperature_c);
    std::vector<ProfilePoint> points;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const double span = nodes[k + 1].depth_m - nodes[k].depth_m;
        const bool cools = nodes[k + 1].celsius != nodes[k].celsius;
        const int steps =
            static_cast<int>(std::ceil(span / (cools ? thermocline_step_m : deep_step_m)));
        const bool is_last = k + 2 == nodes.size();
        for (int i = 0; i < steps + (is_last ? 1 : 0); ++i) {
            const double share = static_cast<double>(i) / steps;
            water.depth_m = nodes[k].depth_m + share * span;
            water.temperature_c =
                nodes[k].celsius + share * (nodes[k + 1].celsius - nodes[k].celsius);
            points.push_back({water.depth_m, sound_speed_m_s(water)});
        }
    }
    return points;
}

double number_of(const CsvTable& csv, const CsvRow& row, std::size_t column, const Limits& limits) {
    const auto value = parse_number(row.fields[column]);
    if (value && *value >= limits.low && *value <= limits.high) return *value;
    refuse({csv.file, row.line}, "{} must be a number from {} to {}", csv.header.fields[column],
           number_text(limits.low), number_text(limits.high));
}

std::vector<ProfilePoint> points_of_file(const std::filesystem::path& file) {
    const CsvTable csv = read_csv(file, largest_file);
    const auto column = [&](const char* name) {
        const auto found = std::ranges::find(csv.header.fields, name);
        const Location header{csv.file, csv.header.line};
        if (found == csv.header.fields.end())
            refuse(header,
                   "a profile of sound speed needs the columns depth_m and sound_speed_m_s");
        if (std::ranges::count(csv.header.fields, name) > 1)
            refuse(header, "the column '{}' occurs twice; leave one out", name);
        return static_cast<std::size_t>(found - csv.header.fields.begin());
    };
    const std::size_t depth = column("depth_m");
    const std::size_t speed = column("sound_speed_m_s");
    std::vector<ProfilePoint> points;
    for (const CsvRow& row : csv.rows) {
        const double depth_m = number_of(csv, row, depth, between(0, 12000));
        const double speed_m_s = number_of(csv, row, speed, sound_speeds_m_s);
        if (!points.empty() && !(depth_m > points.back().depth_m))
            refuse({csv.file, row.line}, "depth_m must be greater than in the row before");
        points.push_back({depth_m, speed_m_s});
    }
    if (points.empty()) throw InputError({csv.file}, "the profile has no rows");
    return points;
}

}  // namespace

SoundProfile sound_profile(const Mission& mission) {
    const SoundProfileConfig& config = *mission.water.profile;
    std::vector<ProfilePoint> points =
        config.file.empty() ? named_points(config, mission.water) : points_of_file(config.file);
    SoundProfile profile;
    profile.range_speed_m_s = mission.water.sound_speed_m_s;
    std::ranges::reverse(points);
    for (const ProfilePoint& point : points) {
        profile.height_m.push_back(mission.scene.water_surface->height_m - point.depth_m);
        profile.speed_m_s.push_back(point.sound_speed_m_s);
    }
    return profile;
}

void add_sound_profiles(const Mission& mission, Scene& scene, std::span<Sonar> sonars) {
    if (!mission.water.profile) return;
    for (const SonarConfig& sensor : mission.sensors) {
        if (sensor.multipath.method == MultipathMethod::none) continue;
        throw InputError("sensor '" + sensor.name +
                         "': multipath needs straight paths, and water.profile bends sound; leave "
                         "out one of the two");
    }
    scene.sound_profile = std::make_shared<const SoundProfile>(sound_profile(mission));
    for (Sonar& sonar : sonars)
        sonar.sound_profile = scene.sound_profile;
}

}  // namespace sonarsim
