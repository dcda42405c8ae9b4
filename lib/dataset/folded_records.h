#pragma once

#include <cstddef>
#include <vector>

#include "dataset/record_file.h"

namespace sonarsim {

/// Pictures have a row (or column) per ping up to 60,000 pings; beyond that, the mean of as many
/// pings as it takes. A PNG cannot be much longer.
inline constexpr std::size_t most_picture_rows = 60'000;

/// How many pings share a row.
std::size_t pings_per_row(std::size_t pings);

/// How many rows that makes.
int picture_rows(std::size_t pings);

/// The float32 records of a file as the rows of a picture: each the mean of as many pings as it
/// takes to have at most `most_picture_rows`.
class FoldedRecords {
  public:
    explicit FoldedRecords(const RecordFile& records);

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

/// The intensity that a picture for the eye shows brightest.
double white_of(FoldedRecords& records);

}  // namespace sonarsim
