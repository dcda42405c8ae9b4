#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dataset/layout.h"

namespace sonarsim {

/// Reads the files of pings, loose or in packs. For each sensor the files of one kind in one pack
/// are in memory at a time, so read pings in their order.
class PingFileReader {
  public:
    /// `layout` must outlive it.
    explicit PingFileReader(const Layout& layout);

    /// The bytes of a file. std::runtime_error when the pack lacks it, std::system_error or
    /// InputError when it cannot be read.
    std::string read(const PingId& ping, const PingFile& kind);

  private:
    struct OpenPack {
        std::filesystem::path path;
        std::string kind;
        std::map<std::string, std::string> files;
    };

    const Layout& layout_;
    std::vector<OpenPack> packs_;  ///< one for each sensor
};

/// The place of a ping's file in the dataset: "fls/polar/000007.npy", or in a pack
/// "fls/pack/000000.tar/fls-000007.polar.npy".
std::string place_of_file(const Layout& layout, const PingId& ping, const PingFile& kind);

}  // namespace sonarsim
