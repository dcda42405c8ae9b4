#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/input_limits.h"

namespace sonarsim {

/// The values that a number of a mission may take.
struct Limits {
    double low;
    double high;
    bool low_allowed = true;
};

/// Larger than anything in the sea. Products of such numbers are finite, and counts fit an int.
inline constexpr double largest_number = 1e9;

constexpr Limits at_least(double low) {
    return {low, largest_number};
}
constexpr Limits above(double low) {
    return {low, largest_number, false};
}
constexpr Limits between(double low, double high) {
    return {low, high};
}
inline constexpr Limits any_position_m{-furthest_m, furthest_m};
/// The speed of sound in water is 1,400 to 1,600 m/s; scale models in a tank may have other speeds.
inline constexpr Limits sound_speeds_m_s{1000.0, 2000.0};
inline constexpr Limits any_angle_deg{-360.0, 360.0};
inline constexpr Limits any_unsigned{0.0, 18446744073709551615.0};  // 64 bits

/// An optional key has a default. `automatic`: it also takes the word auto, kept as 0.
enum class Presence { optional, required, automatic };
inline constexpr Presence required = Presence::required;
inline constexpr Presence or_auto = Presence::automatic;

/// A value that is chosen by name.
template <class T>
struct Choice {
    const char* name;
    T value;
};

template <class T>
using Choices = std::span<const Choice<T>>;

/// The names of an enumeration's values, in its order.
template <class T, class... Names>
constexpr std::array<Choice<T>, sizeof...(Names)> choices_of(Names... names) {
    int value = 0;
    return {Choice<T>{names, static_cast<T>(value++)}...};
}

/// The names of choices, or of other things with a name.
std::vector<std::string> names_of(const auto& all) {
    std::vector<std::string> names;
    names.reserve(std::size(all));
    for (const auto& one : all)
        names.emplace_back(one.name);
    return names;
}

}  // namespace sonarsim
