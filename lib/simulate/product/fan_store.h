#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include "core/last_results.h"
#include "simulate/product/fan.h"
#include "simulate/product/fan_bins.h"

namespace sonarsim {

/// The fans that the variants of a mission share.
class FanStore {
  public:
    /// make_fan_map(sonar).
    std::shared_ptr<const FanMap> map(const Sonar& sonar) {
        return maps_.get(borders_of(sonar),
                         [&] { return std::make_shared<const FanMap>(make_fan_map(sonar)); });
    }
    /// make_fan_bins(sonar).
    std::shared_ptr<const FanBins> bins(const Sonar& sonar) {
        return bins_.get(borders_of(sonar),
                         [&] { return std::make_shared<const FanBins>(make_fan_bins(sonar)); });
    }

  private:
    /// All that a fan's pixels depend on.
    using Borders = std::tuple<View, bool, std::vector<double>>;
    static Borders borders_of(const Sonar& sonar) {
        return {sonar.settings.view, sonar.equal_azimuth, sonar.azimuth_edges_rad};
    }

    LastResults<Borders, std::shared_ptr<const FanMap>> maps_;
    LastResults<Borders, std::shared_ptr<const FanBins>> bins_;
};

}  // namespace sonarsim
