#pragma once

// Limits on what files and missions may hold. Beyond them numbers overflow or lose digits.

namespace sonarsim {

/// The largest magnitude of a coordinate, m, of poses, mounts and vertices alike. A double there is
/// exact to 1.5e-8 m, a hundredth of the narrowest range bin. UTM (1e7), earth-centred (6.4e6) and
/// web Mercator coordinates (2e7) are well within.
inline constexpr double furthest_m = 1e8;

/// The largest time of a pose, s, to either side of 0: 31,700 years. A double there is exact to
/// 0.1 ms. Seconds since 1970 (2e9) are well within; milliseconds since 1970 are not, so that a
/// mistaken unit is found.
inline constexpr double furthest_s = 1e12;

// Densities (kg/m^3) and speeds of sound (m/s), of water and materials. Impedances then lie within
// 1e-18 to 1e18, and their squares and products within 1e-36 to 1e36: normal numbers even as
// floats. The densest metal has 2.3e4 kg/m^3, sound in diamond 1.8e4 m/s.
inline constexpr double min_medium = 1e-9;
inline constexpr double largest_medium = 1e9;

}  // namespace sonarsim
