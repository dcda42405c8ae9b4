#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/sorted_table.h"

namespace sonarsim {

/// The beams of a line array. It measures the sine y / r of an echo: points of one sine lie on a
/// cone about the array's axis, the sensor's y axis.
class ConeBeams {
  public:
    /// No beams.
    ConeBeams() = default;
    /// `edge_sines`: of the beams, beams + 1, increasing.
    explicit ConeBeams(std::span<const double> edge_sines)
        : edges_(std::vector<float>(edge_sines.begin(), edge_sines.end())) {}

    bool exist() const { return !edges().empty(); }
    float mean_width() const {
        return (edges().back() - edges().front()) / static_cast<float>(edges().size() - 1);
    }
    /// The beam that receives echoes of this sine; -1: none.
    int beam(float sine) const {
        if (!(sine >= edges().front() && sine < edges().back())) return -1;
        const auto at = static_cast<int>(edges_(sine));
        return edges()[at] == sine ? at : at - 1;
    }
    /// Calls use(beam, share) for the beams that receive an echo spread evenly over the sines from
    /// `low` to `high`, which must differ.
    template <class Use>
    void for_each(float low, float high, Use use) const {
        const std::vector<float>& edge = edges();
        const float last = std::min(high, edge.back());
        for (int j = beam(std::max(low, edge.front())); j >= 0 && edge[j] < last;) {
            const float part = std::min(last, edge[j + 1]) - std::max(low, edge[j]);
            use(j, part / (high - low));
            if (++j + 1 == static_cast<int>(edge.size())) return;
        }
    }

  private:
    const std::vector<float>& edges() const { return edges_.numbers(); }

    SortedTable edges_;
};

}  // namespace sonarsim
