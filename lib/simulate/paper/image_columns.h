#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "simulate/paper/accumulate.h"

namespace sonarsim {

/// Fills an image [rows, columns] column by column, as many at a time as a cache line holds floats.
class ImageColumns {
  public:
    ImageColumns(int rows, int columns, std::span<float> image)
        : rows_(rows),
          columns_(columns),
          image_(image),
          pending_(static_cast<std::size_t>(std::min(columns, at_once)) * rows) {}

    /// The next column, to be filled before write().
    std::span<float> next() {
        return std::span(pending_).subspan(static_cast<std::size_t>(count_) * rows_, rows_);
    }
    /// Takes the column that next() returned, and writes full cache lines into the image.
    void write() {
        ++count_;
        if (count_ < at_once && written_ + count_ < columns_) return;
        write_beams(pending_, count_, written_, columns_, image_);
        written_ += count_;
        count_ = 0;
    }

  private:
    static constexpr int at_once = 16;

    int rows_, columns_;
    std::span<float> image_;
    std::vector<float> pending_;
    int count_ = 0;    ///< columns in `pending_`
    int written_ = 0;  ///< columns in `image_`
};

}  // namespace sonarsim
