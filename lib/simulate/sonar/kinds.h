#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "input/mission/mission.h"
#include "input/mission/sonar_keys.h"
#include "simulate/ping/sonar.h"
#include "simulate/product/picture.h"

namespace sonarsim {

enum class RecordPictures {
    none,
    strip,   ///< one, a row or a column per ping
    sweeps,  ///< a round one for each sweep of a turning head
};

/// The record of a kind of sonar: the row of a ping in NAME.npy, which holds all pings of a sensor.
/// It is a selection of the ping's bins; without pictures a writer may make it of others.
struct RecordShape {
    std::string_view name;            ///< name of the file; "": the kind has no record
    std::string_view axis = "range";  ///< the meaning of a ping's values, for dataset.json
    bool upright = false;             ///< pings are columns: [range, ping]
    RecordPictures pictures = RecordPictures::none;
    StripStyle style = {};  ///< for a strip
    /// The bin of the image [range, beam] in each value, -1: none. Null: those of the one beam.
    std::vector<std::int32_t> (*bins)(const SonarConfig& config) = nullptr;
    /// Adds the description of the values to the sensor's block in dataset.json.
    void (*describe)(const Sonar& sonar, nlohmann::ordered_json& sensor) = nullptr;
    /// The record has two sides, port and starboard of the track: XTF and mosaics are made of it.
    bool two_sides = false;

    std::size_t values(const SonarConfig& config) const;
};

/// The values of a ping's image [range bins, beams] as its record; `blank` where it shows no bin.
template <class T>
std::vector<T> record_values(const RecordShape& shape, const SonarConfig& config,
                             const std::vector<T>& image, T blank) {
    if (!shape.bins) return image;
    const std::vector<std::int32_t> bins = shape.bins(config);
    std::vector<T> values(bins.size(), blank);
    for (std::size_t k = 0; k < bins.size(); ++k) {
        if (bins[k] >= 0) values[k] = image[static_cast<std::size_t>(bins[k])];
    }
    return values;
}

/// A finished ping, and the pose of the vehicle.
struct PingView {
    const Sonar& sonar;
    const Pose& T_world_vehicle;
    std::uint32_t pose;  ///< index on the trajectory
    const Ping& ping;
    const TracedPing& traced;
    std::span<const std::uint8_t> is_bottom;  ///< Scene::is_bottom
};

struct KindOfSonar {
    SonarKeys keys;  ///< its name, its defaults and the keys that a mission may set
    ViewShape shape;
    bool looks_down;                ///< the default mount: down with z along the bow, or forward
    double gain = 1.0;              ///< m of Eq. 12
    bool range_noise_fades = true;  ///< echoes that range noise delays are weaker, Eq. 8
    bool has_images = false;        ///< a ping is an image: range by azimuth
    RecordShape record = {};
    /// Completes the sonar of make_sonar(); null if nothing is left to do.
    void (*finish)(Sonar& sonar) = nullptr;
    /// Adds the values of a ping besides the altitude to its metadata; null: nothing is measured.
    void (*measure)(const PingView& view, nlohmann::ordered_json& json) = nullptr;
};

/// Every kind, in the order in which messages name them.
const std::vector<KindOfSonar>& kinds_of_sonar();

const KindOfSonar& kind_of(SonarKind kind);

/// The kind's name in a mission.
std::string_view name_of(SonarKind kind);

SonarConfig default_sonar(SonarKind kind);

/// The keys of all kinds, for load_mission() and resolved_yaml().
SonarKeyTable sonar_keys();

// Steps that several kinds share.

/// `bins` + 1 equally spaced values from `low` to `high`, both exact.
std::vector<double> edges(double low, double high, int bins);

/// The azimuth edges of a fan of equal beams.
void add_azimuth(Sonar& sonar);

/// For metadata: an absent value is null.
nlohmann::ordered_json number_or_null(const std::optional<double>& value);

}  // namespace sonarsim
