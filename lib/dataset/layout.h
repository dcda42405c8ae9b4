#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mission/mission.h"

// Where the files of a dataset lie:
//
//     OUT/dataset.json            what this is, the axes of every sensor, whether it is complete
//     OUT/mission.resolved.yaml   the mission with every default written out
//     OUT/trajectory.tum          the pose of every ping number
//     OUT/<sensor>/polar/NNNNNN.npy   float32 [range, azimuth]: intensity as simulated
//     OUT/<sensor>/image/NNNNNN.png   the same in 16 bits: 65535 intensity / full_scale
//     OUT/<sensor>/fan/NNNNNN.png     8 bits, as an operator sees it
//     OUT/<sensor>/stages/NNNNNN.png  8 bits, five fans: direct, and term after term of the model
//     OUT/<sensor>/meta/NNNNNN.json   time, poses, seed, counts, what was measured
//
// Side-scan sonars and echosounders have no image per ping: `meta` only. Those two and profiling
// sonars have a file of records that fills while the mission runs, one record per ping, and files
// that are made of it once it is full:
//
//     side-scan    waterfall.npy   float32 [ping, column]: both sides, from nadir on
//                  waterfall.png, waterfall_view.png
//     echosounder  echogram.npy    float32 [range, ping], in Fortran order: a ping lies together
//                  echogram.png, echogram_view.png
//     profiling    soundings.npy   float64 [ping, beam, 5]: range, x, y, z, quality
//                  soundings.csv, soundings.ply, bathymetry.tif, bathymetry.json, bathymetry.png
//
// A record that is not written yet is zero. The ping's meta file is written after its record, and
// says that it is done.
//
// NNNNNN is the index of the pose on the trajectory, in six digits or as many as the last one
// needs.

namespace sonarsim {

enum class FileKind { polar, image, fan, stages, meta };
inline constexpr FileKind file_kinds[] = {FileKind::polar, FileKind::image, FileKind::fan,
                                          FileKind::stages, FileKind::meta};

/// The name of the kind's folder, and what its files end in (with the dot).
std::string_view name_of(FileKind kind);
std::string_view extension_of(FileKind kind);

/// One ping of a dataset: sensor by its index in Mission::sensors, pose by its index on the
/// trajectory. Ordered by pose, then sensor.
struct PingId {
    std::uint32_t pose = 0;
    std::uint32_t sensor = 0;

    auto operator<=>(const PingId&) const = default;
};

/// The files that hold all pings of a sensor.
struct SeriesFiles {
    std::string record;                 ///< one record per ping
    std::vector<std::string> products;  ///< made of the records of all pings
};

/// Those of each kind of sonar; without names for imaging.
const SeriesFiles& series_files(SonarKind kind);

/// The files of one sensor.
struct SensorLayout {
    std::string name;
    std::vector<FileKind> kinds;  ///< those that are written per ping, in the order of writing
    SeriesFiles series;           ///< without names when the mission wants none
    std::uint32_t every = 1;      ///< pings at every n-th pose
    std::size_t pings = 0;

    bool writes(FileKind kind) const;
};

/// Which files a dataset consists of.
struct Layout {
    std::filesystem::path folder;
    std::vector<SensorLayout> sensors;
    int digits = 6;  ///< of a ping number

    std::string number(std::uint32_t pose) const;
    std::filesystem::path kind_folder(std::size_t sensor, FileKind kind) const;
    std::filesystem::path file(const PingId& ping, FileKind kind) const;
    std::filesystem::path series_file(std::size_t sensor, const std::string& name) const;
    /// The index of a ping among those of its sensor.
    std::size_t record_of(const PingId& ping) const;
    /// Whether every file of the ping is there. Files appear whole or not at all. Of its record
    /// this says nothing.
    bool has(const PingId& ping) const;
    /// Whether every file that is made of all pings is there.
    bool has_products() const;
};

/// InputError when a sensor of the mission would have no files at all.
Layout make_layout(const Mission& mission, std::size_t poses);

/// Every ping of a mission, in order. The index in this list decides to which shard a ping belongs.
std::vector<PingId> list_pings(const Mission& mission, std::size_t poses);

}  // namespace sonarsim
