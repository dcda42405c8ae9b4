#pragma once

namespace sonarsim {

inline constexpr double pi = 3.14159265358979323846;
/// 10 log10(e): a ratio e of powers in dB.
inline constexpr double db_of_e = 4.342944819032518;

constexpr double radians(double degrees) {
    return degrees * (pi / 180.0);
}
constexpr double degrees(double radians) {
    return radians * (180.0 / pi);
}

}  // namespace sonarsim
