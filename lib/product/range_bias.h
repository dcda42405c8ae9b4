#pragma once

#include <vector>

namespace sonarsim {

/// The mean bias in metres of the middle of detect_return()'s run against the middle of the
/// surface, due to range noise, indexed by the length of the run in bins, 0 to `bins`. Empty
/// without range noise, and if its mean delay is longer than all bins together, where images do not
/// show the range of a surface.
///
/// Range noise, Eq. 7 and 8, delays an echo by w, exponential of mean lambda, and fades it by
/// exp(-w / lambda). Let the echoes of a surface arrive evenly over L metres of range from 0 on
/// without noise. With noise the echoes before x, weighted by exp(-(k - 1) w / lambda), are
///     H_k(x) = G_k(x) - G_k(x - L),   G_k(x) = (x - (lambda / k)(1 - exp(-k x / lambda))) / k
/// with G_k = 0 for x < 0: k = 1 counts them, k = 2 adds up their brightness. A bin from x to x'
/// shows the mean (H_2(x') - H_2(x)) / (H_1(x') - H_1(x)). detect_return() of such beams gives the
/// bias.
std::vector<double> range_bias_m(double lambda_m, double bin_m, int bins);

}  // namespace sonarsim
