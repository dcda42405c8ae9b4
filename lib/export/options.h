#pragma once

#include <string>
#include <vector>

namespace sonarsim {

/// In the order of the names of --format.
enum class ExportKind { yolo, coco, masks, imagefolder, webdataset };

/// The options of an export.
struct ExportOptions {
    ExportKind kind = ExportKind::yolo;
    std::vector<std::string> sensors;  ///< names; empty: all
    std::vector<std::string> without;  ///< classes that are not exported as objects
    bool bins = false;         ///< pictures of the bins of imaging sonars instead of the fans
    bool link = false;         ///< hard links to pictures that need no change
    bool polygons = false;     ///< outlines instead of boxes (YOLO) or runs (COCO)
    int tile_px = 0;           ///< side of the tiles of waterfalls, echograms, scans; 0: whole
    int overlap_px = 0;        ///< pixels that neighbouring tiles share
    double least_share = 0.2;  ///< the share of an object's pixels that a tile must show
    int least_pixels = 0;      ///< the pixels that an object must have; 0: as in the dataset
    std::string licence = "unknown";  ///< the licence of the data, for the card of an image folder
};

}  // namespace sonarsim
