#pragma once

#include <cstddef>
#include <span>

#include "simulate/calibrated/signal/range_response.h"

namespace sonarsim {

/// Columns at equal steps of the sine of the angle to the plane across the array.
struct SineGrid {
    double first = 0.0;  ///< sine of column 0
    double step = 1.0;
    int columns = 0;
};

/// The echoes before the receiver: a complex amplitude or, in its real part, a power for every
/// range bin and every column of a sine grid. Columns are contiguous, as echoes come beam by beam.
class EchoGrid {
  public:
    EchoGrid(int rows, int columns);

    int rows() const { return rows_; }
    int columns() const { return columns_; }

    /// The bins of a column, two floats each.
    float* column(int c) { return values_.data() + c * stride_ + front; }
    const float* column(int c) const { return values_.data() + c * stride_ + front; }
    std::size_t stride() const { return stride_; }

    void add(const EchoGrid& more);
    /// The number of cells that hold an echo.
    std::size_t occupied() const;
    /// `power_gains`: by column; empty: 1.
    void convolve_pulse(const RangeTaps& taps, std::span<const float> power_gains, bool powers);

  private:
    // One bin before the first takes echoes between the two; seven more fill the cache line.
    static constexpr std::size_t front = 16;

    int rows_;
    int columns_;
    std::size_t stride_;  ///< floats per column
    std::vector<float> values_;
};

}  // namespace sonarsim
