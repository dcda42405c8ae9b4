#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sonarsim {

/// Ascending numbers at about equal distances, in which a place is found in constant time.
class SortedTable {
  public:
    SortedTable() = default;
    explicit SortedTable(std::vector<float> numbers) : numbers_(std::move(numbers)) {
        if (numbers_.empty()) return;
        const int steps = 4 * static_cast<int>(numbers_.size());
        per_unit_ = static_cast<float>(steps) / (numbers_.back() - numbers_.front());
        // Rounding may put a number into the next step, so a search begins one step earlier.
        std::uint32_t at = 0;
        for (int step = -1; step < steps; ++step) {
            const float begin = numbers_.front() + static_cast<float>(step) / per_unit_;
            while (at + 1 < numbers_.size() && numbers_[at] < begin)
                ++at;
            first_.push_back(at);
        }
    }

    /// The index of the first number that is not below x, or the count of numbers.
    std::uint32_t operator()(float x) const {
        const float step = (x - numbers_.front()) * per_unit_;
        const auto last = static_cast<float>(first_.size() - 1);
        std::uint32_t at = first_[static_cast<int>(std::clamp(step, 0.0F, last))];
        while (at < numbers_.size() && numbers_[at] < x)
            ++at;
        return at;
    }

    const std::vector<float>& numbers() const { return numbers_; }

  private:
    std::vector<float> numbers_;
    std::vector<std::uint32_t> first_;
    float per_unit_ = 0.0F;
};

/// The beams of a line array, which measures the sine y / r: points of one sine lie on a cone.
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
    /// Calls use(beam, share) for the beams of an echo spread evenly from the sine `low` to `high`.
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
