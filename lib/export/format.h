#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/split.h"
#include "export/options.h"
#include "export/source.h"

namespace sonarsim {

/// A picture as it is exported: 8 bits, with the objects that it shows.
struct ExportedPicture {
    std::string name;  ///< unique in the export; letters, digits, '_', '-' and '+'
    SplitPart part = SplitPart::train;
    int width = 0;
    int height = 0;
    std::string png;                    ///< the bytes of the file
    std::filesystem::path original;     ///< a file of these bytes; empty if there is none
    std::vector<SourceObject> objects;  ///< class numbers are above 0
};

/// The context that the writers of an export share.
struct ExportContext {
    std::filesystem::path folder;
    ExportOptions options;
    std::vector<std::string> classes;
    nlohmann::ordered_json datasets;  ///< SourceDataset::description of each
};

/// Writes an export in the layout of a trainer.
class ExportFormat {
  public:
    virtual ~ExportFormat() = default;
    virtual void add(const ExportedPicture& picture) = 0;
    /// After the last picture.
    virtual void finish() = 0;
};

std::unique_ptr<ExportFormat> make_yolo_export(const ExportContext& context);
std::unique_ptr<ExportFormat> make_coco_export(const ExportContext& context);
std::unique_ptr<ExportFormat> make_masks_export(const ExportContext& context);
std::unique_ptr<ExportFormat> make_imagefolder_export(const ExportContext& context);
std::unique_ptr<ExportFormat> make_webdataset_export(const ExportContext& context);

/// "train", "val" or "test".
std::string part_text(SplitPart part);

/// Puts the file of a picture into a folder of the export, which it makes if needed. With `link`
/// the file is a hard link to the original, if there is one. InputError when the disk refuses the
/// link.
void place_picture(const ExportedPicture& picture, const std::filesystem::path& folder, bool link);

}  // namespace sonarsim
