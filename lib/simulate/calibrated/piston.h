#pragma once

namespace sonarsim {

/// The amplitude off the axis of a disc that moves as a whole, 2 J1(x) / x; x is
/// 2 pi (radius / wavelength) times the sine of the angle. 1 on the axis, half of the power at
/// x = 1.6163, the first null at 3.8317, the first side lobe at -17.6 dB.
double piston_pattern(double x);

/// x by the sine of the angle, for a disc whose power is halved at half of `width_rad`.
double piston_scale(double width_rad);

}  // namespace sonarsim
