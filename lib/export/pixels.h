#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "export/cut.h"
#include "export/source.h"

namespace sonarsim {

/// A picture of 8 bits: [height, width, channels] values, grey (1) or RGB (3).
struct Pixels {
    int width = 0;
    int height = 0;
    int channels = 1;
    std::vector<std::uint8_t> values;
    bool is_changed = false;  ///< the file holds other values than these
};

/// The grey of an intensity that is this share of what is white: 255 sqrt(share), the tone of the
/// fan.
std::uint8_t grey_of(double share);

/// Reads the pictures of a dataset, loose or packed. Keeps the files of one pack of each sensor in
/// memory.
class PixelReader {
  public:
    /// The bytes of the file. InputError when it is missing or damaged.
    std::string file(const SourcePicture& picture);

    /// Decodes a picture into 8 bits. PNG files of 8 bits stay as they are; those of 16 bits, whose
    /// values are intensities, and arrays of intensities get the tone of the fan. InputError when
    /// the file is damaged or not of the size that the COCO file says.
    Pixels read(const SourcePicture& picture, const std::string& bytes) const;

  private:
    struct OpenPack {
        std::filesystem::path path;
        std::map<std::string, std::string> files;
    };
    std::map<std::string, OpenPack> packs_;  ///< the open pack of each sensor
};

/// A PNG file of the part of a picture in a frame.
std::string png_of(const Pixels& pixels, const Frame& frame);

}  // namespace sonarsim
