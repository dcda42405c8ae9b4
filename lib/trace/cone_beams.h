#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace sonarsim {

/// The beams of a line array. It measures the sine y / r of an echo: points of one sine lie on a
/// cone about the array's axis, the sensor's y axis.
class ConeBeams {
  public:
    /// No beams.
    ConeBeams() = default;
    /// `edge_sines`: of the beams, beams + 1, increasing.
    explicit ConeBeams(std::span<const double> edge_sines);

    bool exist() const { return !edges_.empty(); }
    float mean_width() const {
        return (edges_.back() - edges_.front()) / static_cast<float>(edges_.size() - 1);
    }
    /// The beam that receives echoes of this sine; -1: none.
    int beam(float sine) const;
    /// Calls use(beam, share) for the beams that receive an echo spread evenly over the sines from
    /// `low` to `high`, which must differ.
    template <class Use>
    void for_each(float low, float high, Use use) const {
        const float last = std::min(high, edges_.back());
        for (int j = beam(std::max(low, edges_.front())); j >= 0 && edges_[j] < last;) {
            const float part = std::min(last, edges_[j + 1]) - std::max(low, edges_[j]);
            use(j, part / (high - low));
            if (++j + 1 == static_cast<int>(edges_.size())) return;
        }
    }

  private:
    std::vector<float> edges_;
    std::vector<int> first_;  ///< the first beam that may hold the sines of a step
    float steps_per_unit_ = 0.0F;
};

}  // namespace sonarsim
