#pragma once

#include <cstddef>
#include <string>

namespace sonarsim {

struct RecordingOptions {
    std::string sensor;          ///< the sensor of a dataset with several; else empty
    std::size_t most_pings = 0;  ///< number of pings to read, from the first; 0: all
};

}  // namespace sonarsim
