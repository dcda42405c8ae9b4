#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "export/tiles.h"
#include "job/parallel.h"

namespace sonarsim {

struct ExportSummary {
    std::map<std::string, std::uint64_t> pictures;  ///< in each part of the split
    std::map<std::string, std::uint64_t> objects;   ///< the number in each class
    std::uint64_t without_objects = 0;              ///< pictures
    LeftOut left_out;
    bool was_there = false;  ///< the folder held this export already
    bool complete = false;
};

/// Exports the datasets in a folder (one dataset, the variants of a mission or a collection; loose
/// or packed) as a folder in the layout of a trainer. A run that is cut off leaves no folder of
/// that name; the same call starts again. InputError as read_export_source() and ExportDestination,
/// and for files that are damaged; std::system_error when the disk fails. When `stop` becomes true,
/// nothing is left.
ExportSummary export_dataset(const std::filesystem::path& folder, const std::filesystem::path& dest,
                             const ExportOptions& options, const ProgressCallback& progress,
                             const std::atomic<bool>& stop);

}  // namespace sonarsim
