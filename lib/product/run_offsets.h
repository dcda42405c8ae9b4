#pragma once

#include <vector>

namespace sonarsim {

/// By how many metres the middle of the strongest_run() of a beam lies beyond the middle of the
/// surface that it shows, on average: by the length of the run in bins, 0 to `bins`. Empty without
/// range noise, where the two agree, and where its mean delay is longer than all bins together, for
/// such images tell nothing of where a surface lies.
///
/// Range noise, Eq. 7 and 8, delays an echo by w, exponential of mean lambda, and fades it by
/// exp(-w / lambda). Of a surface whose echoes arrive evenly over L metres of range from 0 on
/// without noise, those that arrive before x with it, weighted by exp(-(k - 1) w / lambda), are
///     H_k(x) = G_k(x) - G_k(x - L),   G_k(x) = (x - (lambda / k)(1 - exp(-k x / lambda))) / k
/// with G_k = 0 for x < 0: k = 1 counts them, k = 2 adds up their brightness. A bin from x to x'
/// shows the mean (H_2(x') - H_2(x)) / (H_1(x') - H_1(x)). The offsets are what strongest_run()
/// makes of such beams.
std::vector<double> run_offsets_m(double lambda_m, double bin_m, int bins);

}  // namespace sonarsim
