#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "simulate/product/fan.h"
#include "simulate/product/picture.h"

namespace sonarsim {

/// The bin at the centre of each pixel of a fan, for ids, which have no mean. An index into
/// [beams, range bins], beam after beam; -1 outside the sector.
struct FanBins {
    FanFrame frame;
    std::vector<std::int32_t> by_row;     ///< [height, width]
    std::vector<std::int32_t> by_column;  ///< [width, height]
    /// The box around the pixels of each bin; empty (left = right) for a bin between pixels.
    std::vector<PixelBox> boxes;
};

/// Makes the bins for the same fan as make_fan_map(sonar).
FanBins make_fan_bins(const Sonar& sonar);

/// The values of `by_beam` [beams, range bins] at the bins of a fan's pixels; `blank` outside the
/// sector.
template <class T>
std::vector<T> fan_values(std::span<const std::int32_t> bins, const std::vector<T>& by_beam,
                          T blank) {
    std::vector<T> out(bins.size());
    for (std::size_t k = 0; k < bins.size(); ++k)
        out[k] = bins[k] < 0 ? blank : by_beam[static_cast<std::size_t>(bins[k])];
    return out;
}

/// Keeps the last results of a pure function by its arguments: the variants of a job mostly ask for
/// the same.
template <class Arguments, class Result>
class LastResults {
  public:
    template <class Make>
    Result get(Arguments arguments, Make make) {
        constexpr std::size_t capacity = 4;  // sonars of one vehicle
        const std::lock_guard lock(mutex_);
        auto found = std::ranges::find(kept_, arguments, &std::pair<Arguments, Result>::first);
        if (found == kept_.end()) {
            if (kept_.size() == capacity) kept_.erase(kept_.begin());
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
