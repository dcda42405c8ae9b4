#pragma once

#include "dataset/writer.h"

namespace sonarsim {

/// Bytes of a value that the instrument of the calibrated model delivers; 0 if the mission or the
/// model has none.
int raw_bytes(const WriterContext& context);

/// Values of an instrument, as bytes if they have one byte each.
PingNumbers raw_numbers(std::vector<std::uint16_t> values, int bytes,
                        std::vector<std::size_t> shape);

}  // namespace sonarsim
