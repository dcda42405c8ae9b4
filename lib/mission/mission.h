#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/engine_kind.h"
#include "mission/echo_models.h"
#include "mission/instrument.h"
#include "mission/paper_keys.h"
#include "mission/scene_config.h"
#include "mission/source_location.h"
#include "mission/trajectory_keys.h"
#include "mission/variation_keys.h"

namespace sonarsim {

// The defaults of a mission are here and in the headers above. Names carry the unit and are the
// YAML keys.

/// A layer of water that scatters more than the rest.
struct WaterLayerConfig {
    std::array<double, 2> depth_m{};  ///< top and bottom, below scene.water_surface
    double scattering_db_per_m3 = 0.0;

    bool operator==(const WaterLayerConfig&) const = default;
};

/// Profiles of sound speed that are made from temperatures, see assembly/sound_profiles.h.
enum class NamedProfile { none, isothermal, mixed_layer, summer };

/// The speed of sound by depth, in one of two forms.
struct SoundProfileConfig {
    NamedProfile named = NamedProfile::none;
    std::filesystem::path file;  ///< CSV with depth_m and sound_speed_m_s; "": none

    bool operator==(const SoundProfileConfig&) const = default;
};

struct WaterConfig {
    double density_kg_m3 = 997.0;
    double sound_speed_m_s = 1480.0;
    // The calibrated model computes absorption from these.
    double temperature_c = 10.0;
    double salinity_psu = 35.0;
    double depth_m = 10.0;
    // A gentle breeze. Above 100 kHz the noise of wind lies below that of heat.
    double wind_m_s = 5.0;
    WaterContent content = WaterContent::automatic;
    /// Volume backscattering strength, dB re 1 m^2 per m^3; empty: that of `content`.
    std::optional<double> scattering_db_per_m3 = {};
    std::vector<WaterLayerConfig> layers = {};       ///< their scattering is added to the above
    std::optional<SoundProfileConfig> profile = {};  ///< bends sound; none: paths are straight

    bool operator==(const WaterConfig&) const = default;
};

/// The position of a sonar on the vehicle, relative to the default mount of its kind.
struct MountConfig {
    std::array<double, 3> translation_m{};  ///< vehicle frame
    std::array<double, 3> rpy_deg{};        ///< roll, pitch, yaw; applied after the default mount

    bool operator==(const MountConfig&) const = default;
};

enum class MultipathMethod { none, cluster, exact };

/// Multipath via a second surface, Eq. 1-3. Off by default, since it adds half of a ping's time.
struct MultipathConfig {
    MultipathMethod method = MultipathMethod::none;
    int epsilon_bins = 5;  ///< size of a cluster in range, beam and elevation
    /// Largest angle between normals within a cluster. The paper's 15 miss more than 5 % of the
    /// bins on a rough sea floor; 5 miss 2 % and take a tenth more rays.
    double delta_deg = 5.0;

    bool operator==(const MultipathConfig&) const = default;
};

/// The order in which the beams of a fan transmit: a group holds neighbouring beams (in_turn), or
/// every n-th beam.
enum class ShutterOrder { in_turn, interleaved };

/// A sonar whose beams transmit in groups, one after the other.
struct ShutterConfig {
    int groups = 1;  ///< 1: all beams transmit at once
    ShutterOrder order = ShutterOrder::in_turn;
    double period_s = 0.0;  ///< from one group to the next; 0: the two-way time of range_max_m

    bool operator==(const ShutterConfig&) const = default;
};

/// The kinds of sonar; the table in sonar/kinds.h defines them.
enum class SonarKind {
    imaging,
    profiling,
    sidescan,
    echosounder,
    scanning,
};

struct SonarConfig {
    std::string name;  ///< the key below `sensors`
    SonarKind kind = SonarKind::imaging;
    MountConfig mount;
    int every = 1;                ///< the sonar pings at every n-th pose
    bool moves_in_ping = false;   ///< sonar and objects move during a ping
    ShutterConfig shutter;        ///< imaging sonars
    double azimuth_deg = 120.0;   ///< full angle
    double elevation_deg = 20.0;  ///< full angle
    double opening_deg = 30.0;    ///< full angle of a cone, in place of azimuth and elevation
    double sector_deg = 360.0;    ///< full angle that a turning head covers
    double step_deg = 0.9;        ///< angle that the head turns from ping to ping
    double range_min_m = 0.1;
    double range_max_m = 10.0;
    int range_bins = 512;
    int azimuth_bins = 512;
    MultipathConfig multipath;
    NoiseConfig noise;
    StreaksConfig streaks;
    std::filesystem::path preset;  ///< empty after reading: its keys are filled in
    ModelKind model = ModelKind::paper;
    InstrumentConfig instrument;  ///< for the calibrated model only

    bool operator==(const SonarConfig&) const = default;
};

struct AccuracyConfig {
    double relative_l1 = 0.03;  ///< error goal of the noise-free image

    bool operator==(const AccuracyConfig&) const = default;
};

struct OctreeConfig {
    double leaf_m = 0.02;  ///< edge of the leaves

    bool operator==(const OctreeConfig&) const = default;
};

/// Gives a class to all nodes whose names match a pattern.
struct ClassConfig {
    std::string nodes;     ///< `*` stands for any text, `?` for any one byte
    std::string name;      ///< the class
    std::string instance;  ///< one instance of all these nodes; "": each is its own
    SourceLocation place;

    bool operator==(const ClassConfig&) const = default;
};

/// The classes that are background: they have neither contrast, shadow nor visible share.
struct LabelConfig {
    std::vector<std::string> background{"auto"};  ///< classes that are not objects
    SourceLocation place;

    bool operator==(const LabelConfig&) const = default;
};

/// Labels that may be written with the image of a ping.
enum class Label {
    instance,
    share,
    second,
    class_name,
    material,
    elevation,
    height,
    shadow,
    multipath,
    clean,
    direct_only,
    multipath_only,
    objects,
    fan,
};

struct OutputConfig {
    std::filesystem::path folder;
    bool polar = true;        ///< float32 in .npy
    bool image = false;       ///< 16-bit polar PNG
    bool fan = true;          ///< 8-bit PNG
    bool stages = false;      ///< 8-bit PNG of five fans that add the model's terms one by one
    double full_scale = 0.0;  ///< intensity that becomes white; 0: automatic, by sonar
    std::vector<Label> labels = {};  ///< each at most once, in the order of the enumeration
    bool raw = true;                 ///< the instrument's output with the calibrated model

    // Products of all pings of a sonar.
    bool xtf = false;                ///< side-scan sonars: the waterfall as XTF
    bool mosaic = false;             ///< side-scan sonars: the waterfall georeferenced
    SourceLocation place = {};

    bool operator==(const OutputConfig&) const = default;
};

struct Mission {
    std::string name;
    std::uint64_t seed = 0;
    WaterConfig water;
    SceneConfig scene;
    TrajectoryConfig trajectory;
    VehicleConfig vehicle;
    std::vector<SonarConfig> sensors;  ///< in the order of the file
    AccuracyConfig accuracy;
    EngineKind engine = EngineKind::automatic;
    OctreeConfig octree;
    std::vector<ClassConfig> classes;  ///< in the order of the file; the first match applies
    LabelConfig labels;
    OutputConfig output;
    int variants = 0;              ///< number of datasets to draw; 0: the mission as it stands
    std::vector<VaryConfig> vary;  ///< rules of what is drawn, in the order of the file
    Variant variant;               ///< the variant that this mission is

    bool operator==(const Mission&) const = default;
};

}  // namespace sonarsim
