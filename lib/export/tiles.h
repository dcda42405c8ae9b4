#pragma once

#include <cstdint>
#include <functional>

#include "export/format.h"
#include "export/pixels.h"

namespace sonarsim {

/// The pictures and objects that are not in an export.
struct LeftOut {
    std::uint64_t pictures = 0;  ///< pictures or tiles whose pings are not in one part of the split
    std::uint64_t pieces = 0;    ///< objects, or pieces of them, that are too small
};

/// Calls `visit` with the exported pictures of one picture of a dataset: the picture itself, or the
/// tiles of a waterfall, echogram or sweep. Objects of a side-scan are cut at the nadir, so that
/// each is on one side.
void for_each_exported(const SourcePicture& source, const std::vector<SourceObject>& objects,
                       PixelReader& reader, const ExportOptions& options, LeftOut& left_out,
                       const std::function<void(const ExportedPicture&)>& visit);

}  // namespace sonarsim
