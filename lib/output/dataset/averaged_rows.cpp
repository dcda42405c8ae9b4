#include "output/dataset/averaged_rows.h"

#include "simulate/product/contrast.h"

namespace sonarsim {

std::size_t pings_per_row(std::size_t pings) {
    return std::max<std::size_t>(1, (pings + max_picture_rows - 1) / max_picture_rows);
}

int picture_rows(std::size_t pings) {
    const std::size_t each = pings_per_row(pings);
    return static_cast<int>((pings + each - 1) / each);
}

AveragedRows::AveragedRows(const RecordFile& records)
    : records_(records),
      fold_(pings_per_row(records.records())),
      rows_(picture_rows(records.records())),
      record_(records.record_bytes() / sizeof(float)),
      mean_(record_.size()) {}

const std::vector<float>& AveragedRows::row(std::size_t k) {
    const std::size_t first = k * fold_;
    const std::size_t last = std::min(first + fold_, records_.records());
    std::ranges::fill(mean_, 0.0F);
    for (std::size_t i = first; i < last; ++i) {
        records_.read(i, std::as_writable_bytes(std::span(record_)));
        for (std::size_t x = 0; x < mean_.size(); ++x)
            mean_[x] += record_[x];
    }
    for (float& value : mean_)
        value /= static_cast<float>(last - first);
    return mean_;
}

double white_of(AveragedRows& records) {
    Gain gain;
    for (std::size_t k = 0; k < records.rows(); ++k)
        gain.add(records.row(k));
    return gain.white();
}

}  // namespace sonarsim
