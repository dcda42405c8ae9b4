#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dataset/layout.h"

namespace sonarsim {

/// Reads the files of pings, by themselves or in packs. Of each sensor one pack is in memory at a
/// time, and of that the files of one kind: pings are best asked for in order.
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
    std::vector<OpenPack> packs_;  ///< by sensor
};

/// Where a file of a ping lies in the dataset: "fls/polar/000007.npy", or in a pack
/// "fls/pack/000000.tar/fls-000007.polar.npy".
std::string place_of_file(const Layout& layout, const PingId& ping, const PingFile& kind);

}  // namespace sonarsim
