#include "simulate/sonar/kinds.h"

#include <algorithm>
#include <stdexcept>

#include "simulate/product/soundings.h"

namespace sonarsim {

// Each is defined in the file of its name.
KindOfSonar sidescan_kind();
KindOfSonar echosounder_kind();
KindOfSonar scanning_kind();

namespace {

/// A multibeam imaging sonar (section III): range by azimuth, elevation is lost. Looks forward.
KindOfSonar imaging_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::imaging;
    return {.keys = {.kind = SonarKind::imaging,
                     .name = "imaging",
                     .defaults = defaults,
                     .azimuth_bins = true},
            .shape = ViewShape::fan,
            .looks_down = false,
            .gain = 0.5,
            .has_images = true,
            .finish = add_azimuth};
}

/// A multibeam profiling sonar (section V): an imaging sonar with a narrow elevation. Looks down.
KindOfSonar profiling_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::profiling;
    defaults.elevation_deg = 1.0;
    defaults.range_min_m = 0.5;
    defaults.range_max_m = 75.0;
    defaults.range_bins = 750;
    defaults.azimuth_bins = 480;
    return {.keys = {.kind = SonarKind::profiling,
                     .name = "profiling",
                     .defaults = defaults,
                     .azimuth_bins = true},
            .shape = ViewShape::fan,
            .looks_down = true,
            .gain = 0.5,
            .has_images = true,
            .record = {.name = "soundings"},
            .finish = add_azimuth,
            .measure = [](const PingView& view, nlohmann::ordered_json& json) {
                json["soundings"] = beams_with_sounding(view.ping);
            }};
}

}  // namespace

const std::vector<KindOfSonar>& kinds_of_sonar() {
    static const std::vector<KindOfSonar> kinds = {
        imaging_kind(), profiling_kind(), sidescan_kind(), echosounder_kind(), scanning_kind(),
    };
    return kinds;
}

const KindOfSonar& kind_of(SonarKind kind) {
    const auto& kinds = kinds_of_sonar();
    const auto kind_in = [](const KindOfSonar& one) { return one.keys.kind; };
    const auto found = std::ranges::find(kinds, kind, kind_in);
    if (found == kinds.end()) throw std::logic_error("a kind of sonar is not in the table");
    return *found;
}

std::size_t RecordShape::values(const SonarConfig& config) const {
    return bins ? bins(config).size() : static_cast<std::size_t>(config.range_bins);
}

std::string_view name_of(SonarKind kind) {
    return kind_of(kind).keys.name;
}

SonarConfig default_sonar(SonarKind kind) {
    return kind_of(kind).keys.defaults;
}

SonarKeyTable sonar_keys() {
    static const std::vector<SonarKeys> keys = [] {
        std::vector<SonarKeys> all;
        for (const KindOfSonar& kind : kinds_of_sonar())
            all.push_back(kind.keys);
        return all;
    }();
    return keys;
}

std::vector<double> edges(double low, double high, int bins) {
    std::vector<double> out(bins + 1);
    for (int i = 0; i < bins; ++i)
        out[i] = low + (high - low) * i / bins;
    out[bins] = high;
    return out;
}

void add_azimuth(Sonar& sonar) {
    const double half = 0.5 * sonar.settings.view.azimuth_rad;
    std::vector<double>& borders = sonar.azimuth_edges_rad;
    borders = edges(-half, half, sonar.settings.view.beams);
    sonar.beam_azimuths_rad.clear();
    for (std::size_t j = 0; j + 1 < borders.size(); ++j)
        sonar.beam_azimuths_rad.push_back(0.5 * (borders[j] + borders[j + 1]));
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace sonarsim
