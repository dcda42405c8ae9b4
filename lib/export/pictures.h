#pragma once

#include <cstdint>
#include <optional>

#include "dataset/dataset_file.h"
#include "export/options.h"
#include "export/source.h"

namespace sonarsim {

/// sonarsim writes no image id beyond this.
inline constexpr std::uint64_t most_image_id = std::uint64_t{1} << 46;

/// Lists the pictures of a dataset and the COCO files that name them. `part` is the part of the
/// whole dataset, if it has one; else split/ of the dataset divides its pings, and without a split
/// all of them are for training. InputError as read_export_source().
void add_pictures(const DatasetFile& file, std::optional<SplitPart> part,
                  const ExportOptions& options, SourceDataset& dataset);

}  // namespace sonarsim
