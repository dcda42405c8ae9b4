#include "format/sonar_log.h"

#include <stdexcept>

#include "format/byte_fields.h"

namespace sonarsim {

SonarLog read_sonar_log(std::string_view bytes, std::size_t most_pings,
                        std::optional<double> frequency_hz) {
    const std::string_view type = bytes.size() >= 8 ? bytes.substr(4, 4) : std::string_view();
    if (type.starts_with('#')) return read_kmall(bytes, most_pings);
    if (type == "CON0") return read_ek60(bytes, most_pings, frequency_hz);
    if (type == "XML0")
        throw std::runtime_error(
            "is a file of an EK80, which is not read; convert its pings to arrays");
    if (bytes.starts_with("DDF")) return read_aris(bytes, most_pings);
    return read_ping360(bytes, most_pings);
}

}  // namespace sonarsim
