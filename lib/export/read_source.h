#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "export/options.h"
#include "export/source.h"

namespace sonarsim {

/// Describes the datasets to export. InputError, before any long reading, when a dataset is
/// incomplete or damaged, has no label `coco`, or has no pictures of 8 bits of a sensor, with the
/// key to set; and for a name in `options` that no sensor or class has.
ExportSource read_export_source(const std::filesystem::path& folder, const ExportOptions& options);

/// The objects in the pictures of a dataset by the picture's id. InputError, with the line, for a
/// mask that does not fit its picture and box.
std::map<std::uint64_t, std::vector<SourceObject>> read_source_objects(
    const ExportSource& source, const SourceDataset& dataset);

}  // namespace sonarsim
