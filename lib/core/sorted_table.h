#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace sonarsim {

/// Ascending numbers at about equal distances, in which a place is found in constant time. A table
/// without numbers may be made, but not searched.
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

}  // namespace sonarsim
