#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/record_file.h"
#include "dataset/writer.h"

namespace sonarsim {

/// The files of a side-scan sonar for other programs: waterfall.xtf, and mosaic.tif with
/// mosaic.json. Files that the mission does not ask for are left out.
std::vector<std::string> swath_products(const WriterContext& context);

/// `rows`: waterfall.npy.
void write_swath_files(const WriterContext& context, const RecordFile& rows,
                       const std::filesystem::path& folder);

}  // namespace sonarsim
