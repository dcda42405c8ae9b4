#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "mission/mission.h"

namespace sonarsim {

/// Finds out which variants need no render, without their scenes.
class FinishedVariants {
  public:
    /// The number of pings of the dataset in the variant's folder; nothing unless it is complete,
    /// has all its files, and was made of this mission and these input files by a build with the
    /// same bytes.
    std::optional<std::uint64_t> operator()(const Mission& variant);

  private:
    std::map<std::filesystem::path, std::string> sums_;  ///< SHA-256 of input files
};

}  // namespace sonarsim
