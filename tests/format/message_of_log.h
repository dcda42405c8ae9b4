#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "format/sonar_log.h"

namespace sonarsim::test {

/// The reason for which a file is refused, or "accepted".
inline std::string message_of_log(const std::string& bytes,
                                  std::optional<double> frequency_hz = {}) {
    try {
        read_sonar_log(bytes, 100, frequency_hz);
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return "accepted";
}

}  // namespace sonarsim::test
