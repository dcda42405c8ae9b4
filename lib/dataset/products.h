#pragma once

#include <memory>
#include <vector>

#include "dataset/assemble.h"
#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "mission/mission.h"

namespace sonarsim {

/// By sensor; null where one keeps no records.
using RecordFiles = std::vector<std::unique_ptr<RecordFile>>;

/// Opens the record files of a dataset, or makes them.
RecordFiles open_records(const Assembly& assembly, const Layout& layout);

/// Writes all that is made of the records of all pings, from the record files and in memory that
/// does not grow with the number of pings.
void write_products(const Mission& mission, const Assembly& assembly, const Layout& layout,
                    const RecordFiles& records);

/// Pictures have a row (or column) per ping up to 60,000 pings; beyond that, the mean of as many
/// pings as it takes. A PNG cannot be much longer.
inline constexpr std::size_t most_picture_rows = 60'000;

/// waterfall.png and waterfall_view.png beside the record file.
void write_waterfall(const Sonar& sonar, double full_scale, const RecordFile& records,
                     const std::filesystem::path& folder);

/// echogram.png and echogram_view.png.
void write_echogram(const Sonar& sonar, double full_scale, const RecordFile& records,
                    const std::filesystem::path& folder);

/// The soundings of a sensor, and when its pings were.
struct SoundingSource {
    const RecordFile& records;
    std::size_t beams;
    std::uint32_t every;
    const Trajectory& trajectory;
};

/// soundings.csv and soundings.ply.
void write_soundings(const SoundingSource& source, const std::filesystem::path& folder);

/// bathymetry.tif, bathymetry.json and bathymetry.png. `cell_m` as for make_bathymetry().
void write_bathymetry(const SoundingSource& source, double cell_m,
                      const std::filesystem::path& folder);

}  // namespace sonarsim
