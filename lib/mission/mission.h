#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mission/instrument.h"
#include "mission/place.h"
#include "mission/scene_config.h"
#include "mission/trajectory_config.h"
#include "mission/variation_config.h"

namespace sonarsim {

// Every default of a mission stands here and in the headers above. Names carry the unit and are the
// YAML keys, too.

struct WaterConfig {
    double density_kg_m3 = 997.0;
    double sound_speed_m_s = 1480.0;
    // What the calibrated model works out the absorption with.
    double temperature_c = 10.0;
    double salinity_psu = 35.0;
    double depth_m = 10.0;
    double ph = 8.0;

    bool operator==(const WaterConfig&) const = default;
};

/// Where a sonar sits on the vehicle, relative to the default mount of its kind.
struct MountConfig {
    std::array<double, 3> translation_m{};  ///< vehicle frame
    std::array<double, 3> rpy_deg{};        ///< roll, pitch, yaw; applied after the default mount

    bool operator==(const MountConfig&) const = default;
};

/// The random terms of the sonar equations; zero switches a term off.
struct NoiseConfig {
    double range_lambda_m = 0.0;   ///< mean of the exponential range noise, Eq. 7
    double scatterer_m = 0.02;     ///< edge of the cells that share one draw of the range noise
    double add_sigma = 0.0;        ///< Rayleigh scale of the additive noise, Eq. 11
    double mult_sigma = 0.0;       ///< standard deviation of the multiplicative noise, Eq. 13
    bool scale_with_range = true;  ///< additive noise grows with r^2 and the lobe, Eq. 10
    double lobe_sigma_deg = 0.0;   ///< width of that lobe; 0 means azimuth_deg / 8
    double gain = 0.0;             ///< m of Eq. 12; 0 means that of the kind, as the paper has it

    bool operator==(const NoiseConfig&) const = default;
};

enum class MultipathMethod { none, cluster, exact };

/// Echoes by way of a second surface, Eq. 1-3. Off unless a mission asks: they take half as long
/// again as the rest of a ping.
struct MultipathConfig {
    MultipathMethod method = MultipathMethod::none;
    int epsilon_bins = 5;  ///< size of a cluster in range, beam and elevation
    /// Between normals within a cluster. The paper's 15 miss more than 5 % of the bins on a rough
    /// sea floor, 5 miss 2 %, for a tenth more rays.
    double delta_deg = 5.0;

    bool operator==(const MultipathConfig&) const = default;
};

enum class StreakMode { none, add, reduce };

/// Azimuth streaks, Eq. 14-15.
struct StreaksConfig {
    StreakMode mode = StreakMode::none;
    double threshold = 0.08;  ///< share of a range row's echoes, by area, at normal incidence
    double angle_deg = 8.0;   ///< what counts as normal incidence

    bool operator==(const StreaksConfig&) const = default;
};

/// The kinds of sonar. What they are is told by the table in sonar/kinds.h.
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
    int every = 1;                ///< pings at every n-th pose
    double azimuth_deg = 120.0;   ///< full angle
    double elevation_deg = 20.0;  ///< full angle
    double opening_deg = 30.0;    ///< full angle of a cone, which has no azimuth and elevation
    double sector_deg = 360.0;    ///< that a turning head covers
    double step_deg = 0.9;        ///< that it turns from ping to ping
    double range_min_m = 0.1;
    double range_max_m = 10.0;
    int range_bins = 512;
    int azimuth_bins = 512;
    MultipathConfig multipath;
    NoiseConfig noise;
    StreaksConfig streaks;
    std::filesystem::path preset;  ///< empty once a mission is read: its keys are filled in
    ModelKind model = ModelKind::paper;
    InstrumentConfig instrument;  ///< of the calibrated model

    bool operator==(const SonarConfig&) const = default;
};

struct AccuracyConfig {
    double relative_l1 = 0.03;  ///< error goal of the noise-free image

    bool operator==(const AccuracyConfig&) const = default;
};

/// What a sonar's view of the scene is found with.
enum class EngineKind { automatic, rays, octree, slices };

struct SlicesConfig {
    int per_beam = 0;  ///< slices to a beam; 0: what accuracy.relative_l1 calls for

    bool operator==(const SlicesConfig&) const = default;
};

struct OctreeConfig {
    double leaf_m = 0.0;   ///< edge of the leaves; 0: what the bins of the sonar call for
    int memory_mb = 512;   ///< above this, what has not been seen for longest is dropped
    bool literal = false;  ///< the paper to the letter, as a baseline

    bool operator==(const OctreeConfig&) const = default;
};

/// The class of the nodes whose names fit a pattern.
struct ClassConfig {
    std::string nodes;     ///< `*` stands for any text, `?` for any one byte
    std::string name;      ///< of the class
    std::string instance;  ///< of which all these nodes are parts; "": each is one of its own
    Place place;

    bool operator==(const ClassConfig&) const = default;
};

/// What may be told of the bins of a ping besides its image.
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
    semantic,
    coco,
    yolo,
    yolo_polygons,
};

/// Shares of the trajectory to learn with, to choose by and to test with; all 0: it is not split.
struct SplitConfig {
    double train = 0.0;
    double val = 0.0;
    double test = 0.0;
    int gap = 10;    ///< poses at each border that belong to no part
    int rounds = 1;  ///< how often train, val and test follow each other along the trajectory
    Place place;

    bool is_on() const { return train > 0.0 || val > 0.0 || test > 0.0; }
    bool operator==(const SplitConfig&) const = default;
};

/// What the files of pings are put together in.
enum class Pack { none, tar };

enum class FanColours { grey, copper, amber, sea };

/// How fans are drawn; as it stands here they are grey and bare.
struct FanStyleConfig {
    FanColours colours = FanColours::grey;
    bool rings = false;     ///< of equal range, with their numbers
    bool bearings = false;  ///< lines of equal azimuth, with theirs

    bool operator==(const FanStyleConfig&) const = default;
};

struct OutputConfig {
    std::filesystem::path folder;
    bool polar = true;     ///< float32 .npy
    bool image = false;    ///< 16-bit polar PNG
    bool fan = true;       ///< 8-bit Cartesian PNG
    bool meta = true;      ///< JSON per ping
    bool stages = false;   ///< 8-bit PNG of five fans, one term of the model after the other
    int fan_width_px = 0;  ///< 0: one pixel per range bin, at most 1024
    FanStyleConfig fan_style = {};
    double full_scale = 0.0;         ///< intensity that becomes white; 0: found for each sonar
    std::vector<Label> labels = {};  ///< each at most once, in the order of the enumeration
    Place labels_place = {};
    SplitConfig split = {};
    Pack pack = Pack::none;
    double pack_size_mb = 256.0;  ///< at most; a megabyte is a million bytes
    bool raw = true;              ///< of the calibrated model: PNG of what the instrument delivers

    // What is made of all pings of a sonar together.
    bool waterfall = true;           ///< of side-scan
    bool echogram = true;            ///< of echosounders
    bool soundings = true;           ///< of profiling sonars, and the map made of them
    bool scan = true;                ///< of scanning sonars
    double bathymetry_cell_m = 0.0;  ///< 0: by the number of soundings
    bool xtf = false;                ///< of side-scan, for other programs
    bool mosaic = false;             ///< of side-scan, on the ground
    double mosaic_cell_m = 0.0;      ///< 0: by the distance of pings

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
    SlicesConfig slices;
    std::vector<ClassConfig> classes;  ///< in the order of the file: the first that fits counts
    OutputConfig output;
    int variants = 0;              ///< datasets to draw; 0: the mission as it stands
    std::vector<VaryConfig> vary;  ///< what is drawn for each, in the order of the file
    Variant variant;               ///< which of them this mission is

    bool operator==(const Mission&) const = default;
};

}  // namespace sonarsim
