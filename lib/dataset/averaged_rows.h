#pragma once

#include <cstddef>
#include <vector>

#include "dataset/record_file.h"

namespace sonarsim {

/// The most rows (or columns) of pings in a picture; a PNG cannot have many more. If there are more
/// pings, a row is the mean of several.
inline constexpr std::size_t most_picture_rows = 60'000;

/// The number of pings that share a row.
std::size_t pings_per_row(std::size_t pings);

/// The number of rows.
int picture_rows(std::size_t pings);

/// The float32 records of a file as the rows of a picture, each the mean of pings_per_row() pings.
class AveragedRows {
  public:
    explicit AveragedRows(const RecordFile& records);

    std::size_t rows() const { return rows_; }
    /// Row k; valid until the next call.
    const std::vector<float>& row(std::size_t k);

  private:
    const RecordFile& records_;
    std::size_t fold_;
    std::size_t rows_;
    std::vector<float> record_;
    std::vector<float> mean_;
};

/// The intensity of the brightest colour in a picture for people.
double white_of(AveragedRows& records);

}  // namespace sonarsim
