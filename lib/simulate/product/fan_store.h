#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "simulate/product/fan.h"
#include "simulate/product/fan_bins.h"

namespace sonarsim {

/// Keeps the last results of a pure function by its arguments: the variants of a job mostly ask for
/// the same.
template <class Arguments, class Result>
class LastResults {
  public:
    template <class Make>
    Result get(Arguments arguments, Make make) {
        constexpr std::size_t most = 4;  // sonars of one vehicle
        const std::lock_guard lock(mutex_);
        auto found = std::ranges::find(kept_, arguments, &std::pair<Arguments, Result>::first);
        if (found == kept_.end()) {
            if (kept_.size() == most) kept_.erase(kept_.begin());
            kept_.emplace_back(std::move(arguments), make());
            found = kept_.end() - 1;
        }
        return found->second;
    }

  private:
    std::mutex mutex_;
    std::vector<std::pair<Arguments, Result>> kept_;
};

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
