#include "mission/mission.h"

#include "mission/schema.h"

namespace sonarsim {

std::string_view name_of(SonarKind kind) {
    for (const auto& one : sonar_kinds) {
        if (one.value == kind) return one.name;
    }
    return "";
}

SonarConfig default_sonar(SonarKind kind) {
    SonarConfig c;
    c.kind = kind;
    switch (kind) {
        case SonarKind::imaging:
            break;
        case SonarKind::profiling:
            c.elevation_deg = 1.0;
            c.range_min_m = 0.5;
            c.range_max_m = 75.0;
            c.range_bins = 750;
            c.azimuth_bins = 480;
            break;
        case SonarKind::sidescan:
            c.azimuth_deg = 170.0;
            c.elevation_deg = 0.25;
            c.range_min_m = 0.5;
            c.range_max_m = 35.0;
            c.range_bins = 690;
            break;
        case SonarKind::echosounder:
            c.azimuth_deg = 30.0;
            c.range_min_m = 0.5;
            c.range_bins = 200;
            break;
    }
    return c;
}

}  // namespace sonarsim
