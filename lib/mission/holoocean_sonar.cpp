#include "mission/holoocean_sonar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "mission/json_values.h"
#include "mission/limits.h"

namespace sonarsim {

namespace {

enum class Form {
    number,
    variance,    ///< the square of the mission's deviation
    resolution,  ///< width of a bin; the mission has the number of bins
    whole,
    multipath,
    flag,
    streaks,
    nothing,  ///< has no counterpart
};

/// A parameter of a sonar's `configuration` and the key that it becomes.
struct Parameter {
    const char* name;
    Form form;
    const char* key;  ///< key of the sonar, with dots; keys "water." are those of the mission
    Limits limits;
    const char* remark;  ///< the reason for which nothing corresponds
};

constexpr const char* by_goal = "sampling follows from accuracy.relative_l1";
constexpr const char* no_cache = "there is no octree to prepare";
constexpr const char* only_shows = "it only shows something in the game engine";

// docs/holoocean.md has this table for readers.
constexpr std::array parameters{
    Parameter{"Azimuth", Form::number, "azimuth_deg", between(1e-3, 360), ""},
    Parameter{"Elevation", Form::number, "elevation_deg", between(1e-3, 180), ""},
    Parameter{"OpeningAngle", Form::number, "opening_deg", between(1e-3, 180), ""},
    Parameter{"RangeMin", Form::number, "range_min_m", at_least(0), ""},
    Parameter{"RangeMax", Form::number, "range_max_m", above(0), ""},
    Parameter{"RangeBins", Form::whole, "range_bins", between(1, 8192), ""},
    Parameter{"RangeRes", Form::resolution, "range_bins", above(0), ""},
    Parameter{"AzimuthBins", Form::whole, "azimuth_bins", between(1, 8192), ""},
    Parameter{"AzimuthRes", Form::resolution, "azimuth_bins", above(0), ""},
    Parameter{"AddSigma", Form::number, "noise.add_sigma", at_least(0), ""},
    Parameter{"AddCov", Form::variance, "noise.add_sigma", at_least(0), ""},
    Parameter{"MultSigma", Form::number, "noise.mult_sigma", at_least(0), ""},
    Parameter{"MultCov", Form::variance, "noise.mult_sigma", at_least(0), ""},
    Parameter{"RangeSigma", Form::number, "noise.range_lambda_m", at_least(0), ""},
    Parameter{"ScaleNoise", Form::flag, "noise.scale_with_range", {}, ""},
    Parameter{"MultiPath", Form::multipath, "multipath.method", {}, ""},
    Parameter{"ClusterSize", Form::whole, "multipath.epsilon_bins", between(0, 8192), ""},
    Parameter{"AzimuthStreaks", Form::streaks, "streaks.mode", between(-1, 1), ""},
    Parameter{"WaterDensity", Form::number, "water.density_kg_m3", between(0.1, 1e5), ""},
    Parameter{"WaterSpeedSound", Form::number, "water.sound_speed_m_s", between(0.1, 1e5), ""},
    Parameter{"ElevationBins", Form::nothing, "", {}, by_goal},
    Parameter{"ElevationRes", Form::nothing, "", {}, by_goal},
    Parameter{"OpeningAngleBins", Form::nothing, "", {}, by_goal},
    Parameter{"OpeningAngleRes", Form::nothing, "", {}, by_goal},
    Parameter{"CentralAngleBins", Form::nothing, "", {}, by_goal},
    Parameter{"CentralAngleRes", Form::nothing, "", {}, by_goal},
    // Rays and pixels of the sonars that HoloOcean 2.4 added.
    Parameter{"AzimuthRayCount", Form::nothing, "", {}, by_goal},
    Parameter{"AzimuthRayRes", Form::nothing, "", {}, by_goal},
    Parameter{"ElevationRayCount", Form::nothing, "", {}, by_goal},
    Parameter{"ElevationRayRes", Form::nothing, "", {}, by_goal},
    Parameter{"OpeningAngleRays", Form::nothing, "", {}, by_goal},
    Parameter{"CentralAngleRays", Form::nothing, "", {}, by_goal},
    Parameter{"CentralAngleEuclidian", Form::nothing, "", {}, by_goal},
    Parameter{"ResolutionX", Form::nothing, "", {}, by_goal},
    Parameter{"IgnorePlants", Form::nothing, "", {}, "leave the plants out of the scene"},
    Parameter{"UseTags", Form::nothing, "", {}, "output.labels writes labels"},
    Parameter{"ShadowEpsilon", Form::nothing, "", {}, "shadows are exact"},
    Parameter{"UseApprox", Form::nothing, "", {}, "angles are exact"},
    Parameter{"InitOctreeRange", Form::nothing, "", {}, no_cache},
    Parameter{"ViewRegion", Form::nothing, "", {}, only_shows},
    Parameter{"ViewOctree", Form::nothing, "", {}, only_shows},
    Parameter{"ViewRays", Form::nothing, "", {}, only_shows},
    Parameter{"ViewPoints", Form::nothing, "", {}, only_shows},
    Parameter{"ShowWarning", Form::nothing, "", {}, only_shows},
};

class SonarImporter {
  public:
    SonarImporter(const YamlNode& sensor, const SonarType& type, std::vector<std::string>& warnings)
        : type_(type), warnings_(warnings) {
        if (*type.azimuth_deg != '\0') set_key(sonar.settings, "azimuth_deg", type.azimuth_deg);
        if (*type.remark != '\0') {
            sonar.remarks.push_back(std::string(type.type) + ": " + type.remark);
            warnings_.push_back(sensor.place.location().text() + ": " + type.type + ": " +
                                type.remark);
        }
        const YamlNode* const configuration = sensor.find("configuration");
        if (configuration == nullptr) return;
        for (const YamlNode& value : map_at(*configuration, "configuration").items)
            take(value, *configuration);
        // HoloOcean's noise grows with range only if ScaleNoise is set.
        if (setting(sonar.settings, "noise.add_sigma") != nullptr &&
            setting(sonar.settings, "noise.scale_with_range") == nullptr)
            set_key(sonar.settings, "noise.scale_with_range", "false");
        range_order(*configuration);
    }

    ImportedSonar sonar;

  private:
    void drop(const YamlNode& value, const std::string& why) {
        sonar.remarks.push_back(value.key + ": " + why);
        warnings_.push_back(value.key_place.location().text() + ": '" + value.key +
                            "' has no counterpart: " + why);
    }

    void take(const YamlNode& value, const YamlNode& configuration) {
        const auto known = std::ranges::find_if(
            parameters, [&](const Parameter& one) { return value.key == one.name; });
        if (known == parameters.end()) {
            drop(value, "it is not known");
            return;
        }
        const std::string key = known->key;
        const bool lacking = std::ranges::find(type_.lacks, key) != type_.lacks.end();
        if (known->form == Form::nothing || lacking) {
            drop(value, lacking ? std::string("a sonar of kind ") + type_.kind + " has no " + key
                                : known->remark);
            return;
        }
        const bool of_water = key.starts_with("water.");
        set_key(of_water ? sonar.water : sonar.settings, of_water ? key.substr(6) : key,
                value_of(*known, value, configuration));
    }

    std::string value_of(const Parameter& parameter, const YamlNode& node,
                         const YamlNode& configuration) const {
        const std::string name = parameter.name;
        switch (parameter.form) {
            case Form::flag:
                return flag_in(node, name) ? "true" : "false";
            case Form::multipath:
                return flag_in(node, name) ? "cluster" : "none";
            case Form::variance:
                return number_text(std::sqrt(number_in(node, name, parameter.limits)));
            case Form::resolution:
                return bins(parameter, node, configuration);
            case Form::whole:
            case Form::streaks: {
                const double value = number_in(node, name, parameter.limits);
                if (value != std::floor(value))
                    refuse_at(node, "'" + name + "' must be a whole number, not " + node.text);
                if (parameter.form == Form::whole) return number_text(value);
                return value == 0.0 ? "none" : value > 0.0 ? "add" : "reduce";
            }
            default:
                return number_text(number_in(node, name, parameter.limits));
        }
    }

    /// The number of bins that a width gives. InputError if the scenario lacks the range or the
    /// angle that the bins divide.
    static std::string bins(const Parameter& parameter, const YamlNode& node,
                            const YamlNode& configuration) {
        const double width = number_in(node, parameter.name, parameter.limits);
        const bool of_range = std::string_view(parameter.key) == "range_bins";
        const YamlNode* const high = configuration.find(of_range ? "RangeMax" : "Azimuth");
        const YamlNode* const low = configuration.find("RangeMin");
        if (high == nullptr || (of_range && low == nullptr)) {
            refuse_at(node, std::string("'") + parameter.name + "' needs " +
                                (of_range ? "RangeMin and RangeMax" : "Azimuth") + " beside it");
        }
        const double size = number_in(*high, high->key, any_position_m) -
                            (of_range ? number_in(*low, low->key, any_position_m) : 0.0);
        const double count = std::round(size / width);
        if (!(count >= 1.0 && count <= 8192.0)) {
            refuse_at(node, std::string("'") + parameter.name + "' gives " + number_text(count) +
                                " bins; 1 to 8192 are possible");
        }
        return number_text(count);
    }

    static void range_order(const YamlNode& configuration) {
        const YamlNode* const low = configuration.find("RangeMin");
        const YamlNode* const high = configuration.find("RangeMax");
        if (low == nullptr || high == nullptr) return;
        if (*parse_number(low->text) >= *parse_number(high->text))
            refuse_at(*high, "'RangeMax' must be above RangeMin");
    }

    const SonarType& type_;
    std::vector<std::string>& warnings_;
};

}  // namespace

std::span<const SonarType> sonar_types() {
    using Keys = std::vector<std::string_view>;
    static const Keys no_cone{"opening_deg"};
    static const Keys no_cone_no_beams{"opening_deg", "azimuth_bins", "noise.range_lambda_m"};
    static const Keys only_cone{"azimuth_deg", "elevation_deg", "azimuth_bins"};
    constexpr const char* one_side =
        "it looks to one side, and this one to both sides of its axis: a pair of them is one "
        "side-scan sonar of twice the azimuth without their yaw";
    constexpr const char* semantic = "its labels: output.labels writes them";
    static const std::vector<SonarType> types{
        {"ImagingSonar", "imaging", false, no_cone},
        {"RaycastImagingSonar", "imaging", false, no_cone},
        {"GPUImagingSonar", "imaging", false, no_cone},
        {"ProfilingSonar", "profiling", true, no_cone},
        {"RaycastProfilingSonar", "profiling", true, no_cone},
        {"GPUProfilingSonar", "profiling", true, no_cone},
        {"SidescanSonar", "sidescan", true, no_cone_no_beams},
        {"RaycastSidescanSonar", "sidescan", true, no_cone_no_beams, "", one_side},
        {"GPUSidescanSonar", "sidescan", true, no_cone_no_beams, "85", one_side},
        {"SinglebeamSonar", "echosounder", true, only_cone},
        {"RaycastSinglebeamSonar", "echosounder", true, only_cone},
        {"SemanticRaycastSinglebeamSonar", "echosounder", true, only_cone, "", semantic},
        {"GPUSinglebeamSonar", "echosounder", true, only_cone}};
    return types;
}

std::string sonar_type_list() {
    std::string list;
    for (const SonarType& one : sonar_types())
        list += (list.empty() ? "" : ", ") + std::string(one.type);
    return list;
}

void set_key(Settings& settings, const std::string& key, const std::string& value) {
    for (auto& [name, old] : settings) {
        if (name == key) {
            old = value;
            return;
        }
    }
    settings.emplace_back(key, value);
}

const std::string* setting(const Settings& settings, std::string_view key) {
    const auto found = std::ranges::find(settings, key, &Settings::value_type::first);
    return found == settings.end() ? nullptr : &found->second;
}

ImportedSonar import_sonar(const YamlNode& sensor, const SonarType& type,
                           std::vector<std::string>& warnings) {
    return SonarImporter(sensor, type, warnings).sonar;
}

}  // namespace sonarsim
