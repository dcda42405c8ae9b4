#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "visibility/slices/scan.h"

namespace sonarsim {

/// Finds the first slice at or after u; returns the number of slices if there is none. The slices
/// must outlive it.
class SliceFinder {
  public:
    explicit SliceFinder(const std::vector<Slice>& slices) : slices_(slices) {
        const int cells = 4 * static_cast<int>(slices.size());
        low_ = slices.front().u;
        per_u_ = static_cast<float>(cells) / (slices.back().u - low_);
        table_.resize(cells + 1);
        std::uint32_t at = 0;
        for (int c = 0; c <= cells; ++c) {
            const float u = low_ + (static_cast<float>(c) - 1.0F) / per_u_;
            while (at + 1 < slices.size() && slices[at].u < u)
                ++at;
            table_[c] = at;
        }
    }

    std::uint32_t operator()(float u) const {
        const float cell = (u - low_) * per_u_;
        const auto last = static_cast<float>(table_.size() - 1);
        std::uint32_t at = table_[static_cast<int>(std::clamp(cell, 0.0F, last))];
        while (at < slices_.size() && slices_[at].u < u)
            ++at;
        return at;
    }

  private:
    const std::vector<Slice>& slices_;
    std::vector<std::uint32_t> table_;
    float low_;
    float per_u_;
};

}  // namespace sonarsim
