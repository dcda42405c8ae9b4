#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of what varies, with their defaults and their descriptions as in mission.h.

namespace sonarsim {

/// Values of any kind, as YAML.
struct YamlValues {
    std::vector<std::string> items;
};

/// When a key is drawn: for each variant, once for all variants, or for every ping.
enum class VaryPer { variant, dataset, ping };

/// A key of the mission that is drawn at random. Exactly one of the distributions is given.
struct VaryConfig {
    std::filesystem::path preset;  ///< empty after reading: its rules are filled in
    std::string sensor;            ///< likewise
    std::string key;               ///< as in --set
    VaryPer per = VaryPer::variant;
    std::optional<std::array<double, 2>> uniform;      ///< least and largest
    std::optional<std::array<double, 2>> log_uniform;  ///< uniform in the logarithm
    std::optional<std::array<double, 2>> scale;        ///< factors of the key's own value
    std::optional<std::array<double, 2>> whole;        ///< whole numbers, both ends included
    std::optional<std::array<double, 2>> normal;       ///< mean and standard deviation
    std::optional<std::array<double, 2>> within;       ///< limits of a normal draw
    YamlValues choice;                                 ///< all equally likely
    Location place = {};
};

/// Keys of a mission and the values drawn for them, as YAML text.
using DrawnValues = std::vector<std::pair<std::string, std::string>>;

/// The objects that variants of a mission may have, by which classes get the same numbers in all.
struct PossibleObjects {
    std::vector<std::string> classes;  ///< they are numbered first
    /// Each with the class that its file gives it; "": none. The rules then give them classes.
    std::vector<std::pair<std::string, std::string>> instances;
};

/// The variant of a mission.
struct Variant {
    int index = -1;  ///< -1: none
    DrawnValues drawn;
    PossibleObjects objects;  ///< all choices of `vary` together
};

inline constexpr auto vary_pers = choices_of<VaryPer>("variant", "dataset", "ping");

void describe(auto& v, VaryConfig& c) {
    constexpr Limits any{-1e18, 1e18};
    v.path("preset", c.preset,
           "a file of rules, below the mission's folder or one that came with the program, such as "
           "randomised/imaging.yaml; the mission's own rules have precedence");
    v.text("sensor", c.sensor,
           "the sensor whose keys the file's rules vary; default: the mission's");
    v.text("key", c.key,
           "a key of the mission, as --set takes it: sensors.fls.noise.add_sigma, "
           "scene.objects.0.position_m.2");
    v.require(!c.key.empty(), {}, "a rule of 'vary' needs the key 'key' or 'preset'");
    v.choice("per", c.per, vary_pers,
             "when the key is drawn: for every variant, once for all variants (`dataset`), or for "
             "every ping. Keys that may vary per ping are a sensor's mount, the numbers of its "
             "noise and streaks, and the offset and turn of the vehicle");
    v.array("uniform", c.uniform, any, "the least and the largest number");
    v.array("log_uniform", c.log_uniform, any,
            "the least and the largest number; each decade is equally likely");
    v.array("scale", c.scale, any,
            "the least and the largest factor of the value that the mission, its preset or the "
            "default has, drawn as by log_uniform; 0 stays 0");
    v.array("whole", c.whole, any, "the least and the largest whole number");
    v.array("normal", c.normal, any, "mean and standard deviation");
    v.array("within", c.within, any, "limits of a normal draw; a draw outside them is repeated");
    v.text("choice", c.choice, "values of any kind, each equally likely");
    const auto rises = [](const auto& pair) { return !pair || (*pair)[0] <= (*pair)[1]; };
    v.require(c.uniform.has_value() + c.log_uniform.has_value() + c.scale.has_value() +
                      c.whole.has_value() + c.normal.has_value() + !c.choice.items.empty() ==
                  1,
              {},
              "a key that varies needs exactly one of: uniform, log_uniform, scale, whole, normal, "
              "choice");
    v.require(rises(c.uniform) && rises(c.log_uniform) && rises(c.scale) && rises(c.whole) &&
                  rises(c.within),
              {"uniform", "log_uniform", "scale", "whole", "within"},
              "the first number must not be above the second");
    v.require(!c.log_uniform || (*c.log_uniform)[0] > 0.0, {"log_uniform"},
              "'log_uniform' takes numbers above 0");
    v.require(!c.scale || (*c.scale)[0] > 0.0, {"scale"}, "'scale' takes numbers above 0");
    v.require(!c.scale || c.per != VaryPer::ping, {"scale", "per"},
              "'scale' is not drawn for every ping");
    v.require(!c.normal || (*c.normal)[1] >= 0.0, {"normal"},
              "the standard deviation must not be negative");
    v.require(!c.within || c.normal, {"within"}, "'within' needs 'normal'");
    v.require(!c.whole || ((*c.whole)[0] == std::floor((*c.whole)[0]) &&
                           (*c.whole)[1] == std::floor((*c.whole)[1])),
              {"whole"}, "'whole' takes whole numbers");
    v.require(c.per != VaryPer::ping || !c.normal || c.within, {"normal", "per"},
              "a normal draw for every ping needs 'within', the limits of the draw");
}

}  // namespace sonarsim
