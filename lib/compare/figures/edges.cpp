#include "compare/figures/edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/elementary.h"
#include "core/normal_tail.h"

namespace sonarsim {

namespace {

// These numbers are chosen, except for the rise; docs/compare.md has the errors on simulated steps.
constexpr double least_contrast = 4.0;     // 6 dB
constexpr double most_full = 0.03;         // share of clipped bins
constexpr double most_misfit = 0.25;       // a quarter's mean off, by the bright level
constexpr double weight_floor = 0.1;       // share of bright; dark skirts count less
constexpr double rise_10_to_90 = 2.56310;  // 2 x 1.28155 standard deviations
constexpr double least_sigma = 0.15;       // bins; narrower steps look the same
constexpr double most_reach = 0.6;         // a step's end from the middle, by half the window
constexpr double farthest_off = 8.0;       // deviations; the density there is 5e-15
constexpr int most_fit_steps = 15;
constexpr double fine_enough = 0.01;  // a hundredth of a bin, or of the width

using Parameters = Eigen::Matrix<double, 5, 1>;
using Normal = Eigen::Matrix<double, 5, 5>;

/// A window with each row replaced by the means of the row's two halves, [along, half]. This makes
/// a fit faster, and two halves still show a slant.
struct Grouped {
    static constexpr int groups = 2;
    std::vector<double> power;
    int along = 0;
    std::array<double, groups> y{};  ///< across, from the middle
    double half_across = 0.0;
    double variance = 0.0;  ///< the variance of y within a group

    template <class Visit>
    void for_each(const Visit& visit) const {
        for (int i = 0; i < along; ++i) {
            for (std::size_t k = 0; k < groups; ++k)
                visit(power[static_cast<std::size_t>(i) * groups + k], i - 0.5 * (along - 1), y[k],
                      i);
        }
    }
    /// The mean power of rows [from, to).
    double mean_of(int from, int to) const {
        const auto at = [&](int row) { return power.begin() + std::ptrdiff_t{row} * groups; };
        return std::accumulate(at(from), at(to), 0.0) / ((to - from) * groups);
    }
};

Grouped grouped(const StepWindow& window) {
    constexpr int groups = Grouped::groups;
    Grouped out;
    out.along = window.along;
    out.half_across = 0.5 * window.across;
    const double width = static_cast<double>(window.across) / groups;
    out.variance = (width * width - 1.0) / 12.0;
    for (int k = 0; k < groups; ++k) {
        const int from = k * window.across / groups;
        const int to = (k + 1) * window.across / groups;
        out.y[static_cast<std::size_t>(k)] = 0.5 * (from + to - window.across);
    }
    for (int i = 0; i < window.along; ++i) {
        for (int k = 0; k < groups; ++k) {
            const int from = k * window.across / groups;
            const int to = (k + 1) * window.across / groups;
            double sum = 0.0;
            for (int j = from; j < to; ++j)
                sum += window.at(i, j);
            out.power.push_back(sum / (to - from));
        }
    }
    return out;
}

/// The step's parameters: both levels, place, slant, and the logarithm of the width.
struct Step {
    Parameters p;
    double deviation;  ///< the width, widened by the slant within a group

    Step(const Parameters& parameters, double variance)
        : p(parameters), deviation(std::sqrt(exponential(2.0 * p[4]) + variance * p[3] * p[3])) {}
};

/// The mean power at a place and its derivatives by the parameters.
struct StepModel {
    double mean;
    Parameters slope;
};

StepModel step_at(const Step& step, double x, double y) {
    const Parameters& p = step.p;
    const double z = (x - p[2] - p[3] * y) / step.deviation;
    const double off = std::min(std::fabs(z), farthest_off);
    const double density = normal_density(off);
    const double share = z > 0.0 ? 1.0 - normal_tail(off) : normal_tail(off);
    const double rise = p[1] - p[0];
    const double by_place = -rise * density / step.deviation;
    return {p[0] + rise * share, {1.0 - share, share, by_place, by_place * y, -rise * density * z}};
}

/// The next step of the fit by Gauss and Newton's method.
Parameters improved(const Grouped& window, const Step& step, double bright) {
    Normal normal = Normal::Zero();
    Parameters right = Parameters::Zero();
    window.for_each([&](double power, double x, double y, int) {
        const StepModel model = step_at(step, x, y);
        // The standard deviation of speckle equals its mean.
        const double error = std::max(model.mean, 0.0) + weight_floor * bright;
        const Parameters scaled = model.slope / error;
        normal.noalias() += scaled * scaled.transpose();
        right += scaled * ((power - model.mean) / error);
    });
    normal.diagonal() *= 1.01;
    normal.diagonal().array() += 1e-12;
    const Parameters change = normal.ldlt().solve(right);
    Parameters out = step.p + change;
    // Limits the steps of the nonlinear parameters.
    constexpr std::array most{1.5, 0.3, 0.7};
    for (int k = 2; k < 5; ++k) {
        const double least = most[static_cast<std::size_t>(k - 2)];
        out[k] = step.p[k] + std::clamp(change[k], -least, least);
    }
    out[4] = std::max(out[4], logarithm(least_sigma));
    return out;
}

/// True if each quarter of the window has the mean of the fit, nearly.
bool fits_quarters(const Grouped& window, const Step& step, double bright) {
    std::array<double, 4> off{};
    window.for_each([&](double power, double x, double y, int i) {
        off[static_cast<std::size_t>(4 * i / window.along)] += power - step_at(step, x, y).mean;
    });
    const double most = most_misfit * bright * 0.25 * static_cast<double>(window.power.size());
    return std::ranges::all_of(off, [&](double sum) { return std::fabs(sum) < most; });
}

/// An image with the direction of the step first.
struct Turned {
    const ImageView& image;
    StepAlong direction;

    float at(int along, int across) const {
        return direction == StepAlong::range ? image.at(along, across) : image.at(across, along);
    }
};

/// The part of an image that is searched: [from, to) along the step, strips of a width across it.
struct Strips {
    int from = 0, to = 0;
    int across_from = 0, across_to = 0;
    int length = 0, width = 0;  ///< the window's
};

Strips strips_of(const ImageView& image, const EdgeSearch& search, StepAlong along) {
    const PatchSize size = search.window;
    const RangeZone zone = search.zone;
    if (along == StepAlong::range)
        return {zone.from, zone.to, 0, image.beams, size.ranges, size.beams};
    return {0, image.beams, zone.from, zone.to, size.beams, size.ranges};
}

/// The middles of those windows of a strip whose step is the greatest within half a window.
std::vector<int> steps_in(const Turned& image, const Strips& strips, int across) {
    std::vector<double> sums(1, 0.0);
    for (int i = strips.from; i < strips.to; ++i) {
        double sum = 0.0;
        for (int j = across; j < across + strips.width; ++j)
            sum += image.at(i, j);
        sums.push_back(sums.back() + sum);
    }
    const auto between = [&](int a, int b) {
        return sums[static_cast<std::size_t>(b)] - sums[static_cast<std::size_t>(a)];
    };
    const int half = strips.length / 2;
    const int quarter = strips.length / 4;
    const int count = strips.to - strips.from;
    std::vector<double> rise(static_cast<std::size_t>(std::max(count, 0)) + 1);
    for (int c = half; c + half <= count; ++c)
        rise[static_cast<std::size_t>(c)] = std::fabs(between(c, c + half) - between(c - half, c));
    std::vector<int> out;
    for (int c = half; c + half <= count; ++c) {
        const auto own = rise.begin() + c;
        if (std::max_element(own - half, own + std::min(half, count - c) + 1) != own) continue;
        const double before = between(c - half, c - quarter);
        const double after = between(c + quarter, c + half);
        if (std::max(before, after) >= least_contrast * std::min(before, after))
            out.push_back(strips.from + c);
    }
    return out;
}

}  // namespace

double width_of_step(const StepWindow& all) {
    const Grouped window = grouped(all);
    const int half = window.along / 2;
    const int quarter = window.along / 4;
    Parameters p;
    p << window.mean_of(0, quarter), window.mean_of(window.along - quarter, window.along), 0.0, 0.0,
        0.0;
    const double bright = std::max(p[0], p[1]);
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (!(bright > 0.0)) return none;
    double last = 1.0;
    for (int k = 0; k < most_fit_steps && last > fine_enough; ++k) {
        const Parameters next = improved(window, {p, window.variance}, bright);
        last = (next - p).tail<3>().cwiseAbs().maxCoeff();
        p = next;
        if (!p.allFinite() || std::fabs(p[2]) > half || p[4] > logarithm(half)) return none;
    }
    const double width = rise_10_to_90 * exponential(p[4]);
    // Both levels have to show over the whole width of the window: a thin line is no step.
    const double reach = std::fabs(p[2]) + 0.5 * width + std::fabs(p[3]) * window.half_across;
    const bool is_step =
        reach < most_reach * half && fits_quarters(window, {p, window.variance}, bright);
    return is_step ? width : none;
}

std::vector<Edge> edges_of(const ImageView& image, const EdgeSearch& search, StepAlong along) {
    std::vector<Edge> out;
    const Turned turned{image, along};
    const Strips strips = strips_of(image, search, along);
    for (int across = strips.across_from; across + strips.width <= strips.across_to;
         across += strips.width) {
        for (const int middle : steps_in(turned, strips, across)) {
            StepWindow window{{}, strips.length / 2 * 2, strips.width};
            int full = 0;
            for (int i = middle - window.along / 2; i < middle + window.along / 2; ++i) {
                for (int j = across; j < across + window.across; ++j)
                    window.power.push_back(turned.at(i, j));
            }
            if (search.full_power > 0.0F)
                full = static_cast<int>(std::ranges::count_if(
                    window.power, [&](float power) { return power >= search.full_power; }));
            if (full > most_full * static_cast<double>(window.power.size())) continue;
            const double width = width_of_step(window);
            if (!std::isfinite(width)) continue;
            const int centre = across + strips.width / 2;
            out.push_back(along == StepAlong::range ? Edge{middle, centre, width}
                                                    : Edge{centre, middle, width});
        }
    }
    return out;
}

}  // namespace sonarsim
