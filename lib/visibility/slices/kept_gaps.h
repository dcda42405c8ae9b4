#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/adaptive_slices.h"

namespace sonarsim {

/// Rows of any lengths, one after the other.
template <typename T>
class Rows {
  public:
    void add(std::span<const T> row) {
        items_.insert(items_.end(), row.begin(), row.end());
        end_row();
    }

    /// Additions to items() belong to the next row, until end_row().
    std::vector<T>& items() { return items_; }
    const std::vector<T>& items() const { return items_; }
    void end_row() { ends_.push_back(items_.size()); }

    std::size_t size() const { return ends_.size(); }

    std::span<const T> operator[](std::size_t row) const {
        const std::size_t begin = row == 0 ? 0 : ends_[row - 1];
        return std::span(items_).subspan(begin, ends_[row] - begin);
    }

  private:
    std::vector<T> items_;
    std::vector<std::size_t> ends_;
};

/// The results of AdaptiveSlices in the gaps of some beams, so that they can be checked later
/// without another scan.
struct KeptGaps {
    struct Beam {
        std::uint32_t first_gap;  ///< the frame's gaps of this beam are [first_gap, next_gap)
        std::uint32_t next_gap;
        std::size_t first_slice;   ///< row of `spans`
        std::size_t first_around;  ///< row of `of_slices`, `all` and `unseen`
        double difference;         ///< as in SliceError
    };

    std::vector<Beam> beams;
    Rows<Subgap> subgaps;  ///< a row per beam
    std::vector<Slice> slices;
    Rows<VisibleSpan> spans;        ///< a row per slice
    Rows<std::uint32_t> of_slices;  ///< as in AroundGap; a row per gap
    Rows<Candidate> all;
    Rows<UnseenPiece> unseen;
};

}  // namespace sonarsim
