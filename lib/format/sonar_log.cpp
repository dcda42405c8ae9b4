#include "format/sonar_log.h"
namespace sonarsim {

SonarLog read_sonar_log(std::string_view bytes, std::size_t most_pings,
                        std::optional<double> frequency_hz) {
    const std::string_view type = bytes.size() >= 8 ? bytes.substr(4, 4) : std::string_view();
    if (type.starts_with('#')) return read_kmall(bytes, most_pings);
    if (type == "CON0") return read_ek60(bytes, most_pings, frequency_hz);
    if (type == "XML0") return read_ek80(bytes, most_pings, frequency_hz);
    if (bytes.starts_with("DDF\x05")) return read_aris(bytes, most_pings);
    if (bytes.starts_with("DDF")) return read_didson(bytes, most_pings);
    if (is_all_file(bytes)) return read_all(bytes, most_pings);
    return read_ping360(bytes, most_pings);
}

}  // namespace sonarsim
