#pragma once

#include <functional>
#include <vector>

namespace sonarsim {

/// A number with the interval that holds the true one in 95 of 100 cases.
struct Bounded {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;

    double half_width() const { return 0.5 * (high - low); }
    bool holds(double x) const { return low <= x && x <= high; }
};

/// Makes an interval wider by an independent error.
void widen(Bounded& m, double by);

/// The estimate with all weights 1, with its interval from `draws` bootstrap samples of the units:
/// 1.96 standard deviations to either side, and an independent error of `least` for effects that
/// the closed forms leave out. Samples whose estimate is not finite do not count.
Bounded bootstrap(int count, const std::function<double(const std::vector<double>&)>& estimate,
                  double least = 0.0, int draws = 80);

/// The same for several numbers of one estimate.
std::vector<Bounded> bootstrap_all(
    int count, const std::function<std::vector<double>(const std::vector<double>&)>& estimate,
    const std::vector<double>& least, int draws = 80);

}  // namespace sonarsim
