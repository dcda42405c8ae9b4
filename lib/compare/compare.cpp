#include "compare/compare.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compare/exchange.h"
#include "compare/figures/distances.h"
#include "compare/measure_images.h"
#include "compare/measure_soundings.h"
#include "compare/student.h"
#include "core/error.h"
#include "core/in_parallel.h"
#include "core/random.h"
#include "recording/recording_file.h"

namespace sonarsim {

namespace {

constexpr double significance = 0.05;
constexpr int exchanges = 200;

double tolerance_of(Tolerance kind, double real) {
    switch (kind) {
        case Tolerance::tenth:
            return 0.1 * std::fabs(real);
        case Tolerance::decibel:
            return 1.0;
        case Tolerance::correlation:
            return 0.05;
        case Tolerance::share:
            return std::max(0.001, 0.1 * std::fabs(real));
    }
    return 0.0;
}

ComparedFigure compared(const Measured& real, const Measured& simulated, Pairing pairing,
                        std::uint32_t seed) {
    ComparedFigure figure;
    figure.name = real.name;
    figure.estimate = estimate(real, simulated, pairing, seed);
    const Estimate& e = figure.estimate;
    figure.tolerance = tolerance_of(real.tolerance, e.real);
    const double factor = e.degrees > 0.0 ? student_95(e.degrees) : 0.0;
    figure.real_half = factor * e.real_error;
    figure.simulated_half = factor * e.simulated_error;
    figure.difference_half = factor * e.difference_error;
    const double off = e.simulated - e.real;
    if (e.degrees > 0.0 && e.difference_error > 0.0) figure.standardised = off / e.difference_error;
    figure.agrees = std::fabs(off) <= std::max(figure.tolerance, figure.difference_half);
    return figure;
}

/// Holm's step-down correction: the k-th smallest of m is multiplied by m - k.
void adjust(std::vector<ComparedFigure>& figures) {
    std::vector<std::size_t> order(figures.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return figures[i].estimate.p; });
    double largest = 0.0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        ComparedFigure& figure = figures[order[k]];
        const double own = figure.estimate.p * static_cast<double>(order.size() - k);
        largest = std::max(largest, std::min(1.0, own));
        figure.adjusted_p = largest;
        figure.differs = largest < significance;
    }
}

/// A figure of common places must also differ in the test by exchange, since a few bright places
/// cause other tails than Student's. A figure without variance has no such tails.
void adjust_by_exchange(std::vector<ComparedFigure>& figures, const std::vector<double>& p) {
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (figures[i].estimate.difference_error == 0.0) continue;
        figures[i].adjusted_p = std::max(figures[i].adjusted_p, p[i]);
        figures[i].differs = figures[i].adjusted_p < significance;
    }
}

std::vector<double> sum_of(const std::vector<std::vector<double>>& counts) {
    std::vector<double> sum(counts.front().size());
    for (const std::vector<double>& own : counts) {
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += own[i];
    }
    return sum;
}

/// The 95 % quantile of the Jensen-Shannon divergence over draws that redistribute all places of
/// both recordings; common places are exchanged one by one.
double chance_distance(const MeasuredHistogram& real, const MeasuredHistogram& simulated,
                       bool is_paired, std::uint32_t seed) {
    std::vector<double> drawn(exchanges);
    in_parallel(drawn.size(), [&](std::size_t k) {
        std::vector<double> one(real.counts.front().size());
        std::vector<double> other = one;
        const auto deal = [&](const std::vector<double>& counts, bool to_one) {
            std::vector<double>& to = to_one ? one : other;
            for (std::size_t i = 0; i < counts.size(); ++i)
                to[i] += counts[i];
        };
        const auto draw = [&](std::size_t place, std::uint32_t set) {
            const PhiloxBlock block = philox({static_cast<std::uint32_t>(k),
                                              static_cast<std::uint32_t>(place), set, 0x6465616cU},
                                             {seed, 0});
            return unit_float(block.x0);
        };
        const auto all = static_cast<float>(real.counts.size() + simulated.counts.size());
        const float share = static_cast<float>(real.counts.size()) / all;
        for (std::size_t i = 0; i < real.counts.size(); ++i)
            deal(real.counts[i], draw(i, 0) < (is_paired ? 0.5F : share));
        for (std::size_t i = 0; i < simulated.counts.size(); ++i)
            deal(simulated.counts[i], is_paired ? draw(i, 0) >= 0.5F : draw(i, 1) < share);
        const bool is_empty = std::accumulate(one.begin(), one.end(), 0.0) == 0.0 ||
                              std::accumulate(other.begin(), other.end(), 0.0) == 0.0;
        drawn[k] = is_empty ? 1.0 : jensen_shannon(one, other);
    });
    std::ranges::sort(drawn);
    return drawn[static_cast<std::size_t>(0.95 * exchanges)];
}

ComparedHistogram compared(const MeasuredHistogram& real, const MeasuredHistogram& simulated,
                           bool is_paired, std::uint32_t seed) {
    const std::vector<double> a = sum_of(real.counts);
    const std::vector<double> b = sum_of(simulated.counts);
    ComparedHistogram out{real.name, real.unit};
    out.jensen_shannon = jensen_shannon(a, b);
    out.kullback_leibler = kullback_leibler(a, b);
    out.earth_movers = real.bin_width * earth_movers(a, b);
    out.chance_jensen_shannon = chance_distance(real, simulated, is_paired, seed);
    return out;
}

/// The zones of both recordings. With a common grid both have the zones of their mean, so that
/// chance does not shift the zones of one against the other's.
std::pair<Zones, Zones> zones_of_both(const RecordedImages& real, const RecordedImages& simulated,
                                      bool has_one_grid) {
    std::vector<double> a = mean_powers_of(real);
    const std::vector<double> b = mean_powers_of(simulated);
    if (!has_one_grid) return {zones_of(a), zones_of(b)};
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = 0.5 * (a[i] + b[i]);
    return {zones_of(a), zones_of(a)};
}

CommonBands bands_of(const RecordedImages& a, const RecordedImages& b) {
    const auto end = [](const RecordedImages& i) {
        return i.first_range_m + i.ranges * i.range_step_m;
    };
    CommonBands bands;
    bands.range_from_m = std::max(a.first_range_m, b.first_range_m);
    bands.range_to_m = std::min(end(a), end(b));
    if (bands.range_to_m <= bands.range_from_m)
        throw InputError("the recordings have no ranges in common");
    if (a.bearing_rad.empty() || b.bearing_rad.empty()) return bands;
    const auto [low_a, high_a] = std::ranges::minmax(a.bearing_rad);
    const auto [low_b, high_b] = std::ranges::minmax(b.bearing_rad);
    if (std::min(high_a, high_b) > std::max(low_a, low_b)) {
        bands.bearing_from_rad = std::max(low_a, low_b);
        bands.bearing_to_rad = std::min(high_a, high_b);
    }
    return bands;
}

struct BothMeasured {
    Measurement real, simulated;
    Pairing pairing;
};

BothMeasured measure_both(const Recording& real, const Recording& simulated, bool is_relative) {
    if (real.kind == RecordedKind::soundings) {
        const CommonAngles angles = common_angles(real, simulated);
        const auto measured = [&](const Recording& one) {
            return measure_soundings(one, angles, is_relative ? mean_power_of_soundings(one) : 1.0);
        };
        return {measured(real), measured(simulated), {}};
    }
    RecordedImages a = images_of(real);
    RecordedImages b = images_of(simulated);
    if (is_relative) {
        make_relative(a);
        make_relative(b);
    }
    const bool has_one_grid = have_one_grid(a, b);
    const auto [zones_a, zones_b] = zones_of_both(a, b, has_one_grid);
    const PatchSize patch = patch_size_of(a, b);
    const CommonBands bands = bands_of(a, b);
    return {measure_images(a, {patch, zones_a, bands}),
            measure_images(b, {patch, zones_b, bands}),
            {has_one_grid, has_one_grid && a.powers.size() == b.powers.size()}};
}

/// The figure that is furthest off among those that do not agree; else among all that differ.
void choose_first_change(Comparison& out) {
    const auto weight = [](const ComparedFigure& f) {
        return std::pair(!f.agrees, std::fabs(f.standardised));
    };
    for (std::size_t i = 0; i < out.figures.size(); ++i) {
        if (!out.figures[i].differs) continue;
        const bool is_first = out.first_change < 0;
        if (is_first || weight(out.figures[i]) >
                            weight(out.figures[static_cast<std::size_t>(out.first_change)]))
            out.first_change = static_cast<int>(i);
    }
}

}  // namespace

Comparison compare_recordings(const Recording& real, const Recording& simulated,
                              std::uint32_t seed) {
    if (real.kind != simulated.kind)
        throw InputError(real.name + " is of the kind " + name_of_kind(real.kind) + ", " +
                         simulated.name + " of the kind " + name_of_kind(simulated.kind) +
                         "; compare recordings of one kind");
    // A recording without a known largest value has no absolute level.
    const bool is_relative = real.law.full_value == 0.0 || simulated.law.full_value == 0.0;
    BothMeasured both = measure_both(real, simulated, is_relative);
    Comparison out;
    out.real = real.name;
    out.simulated = simulated.name;
    out.real_pings = std::max(real.pings.size(), real.soundings.size());
    out.simulated_pings = std::max(simulated.pings.size(), simulated.soundings.size());
    out.has_one_grid = both.pairing.locations;
    out.has_relative_levels = is_relative;
    std::vector<std::pair<const Measured*, const Measured*>> pairs;
    for (const Measured& figure : both.real.figures) {
        const auto found = std::ranges::find(both.simulated.figures, figure.name, &Measured::name);
        if (found != both.simulated.figures.end()) pairs.emplace_back(&figure, &*found);
    }
    std::vector<ComparedFigure> figures(pairs.size());
    in_parallel(pairs.size(), [&](std::size_t i) {
        figures[i] = compared(*pairs[i].first, *pairs[i].second, both.pairing, seed);
    });
    // A figure without an error is ignored: it was found at fewer than eight places.
    std::vector<ExchangedFigure> exchanged;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (figures[i].estimate.degrees == 0.0) continue;
        const double error = figures[i].estimate.difference_error;
        exchanged.push_back({pairs[i].first, pairs[i].second, error});
        out.figures.push_back(std::move(figures[i]));
    }
    if (out.figures.empty())
        throw InputError("the recordings have no figure in common: too few ranges, beams or pings");
    adjust(out.figures);
    if (both.pairing.locations) adjust_by_exchange(out.figures, exchange_p(exchanged, seed));
    for (std::size_t i = 0; i < both.real.histograms.size(); ++i)
        out.histograms.push_back(compared(both.real.histograms[i], both.simulated.histograms[i],
                                          both.pairing.locations, seed));
    out.agreeing =
        static_cast<std::size_t>(std::ranges::count_if(out.figures, &ComparedFigure::agrees));
    out.differing =
        static_cast<std::size_t>(std::ranges::count_if(out.figures, &ComparedFigure::differs));
    choose_first_change(out);
    for (auto [from, to] : {std::pair(&both.real, &out.real_levels),
                            std::pair(&both.simulated, &out.simulated_levels)}) {
        to->level_by_range_db = std::move(from->level_by_range_db);
        to->first_range_m = from->first_range_m;
        to->range_step_m = from->range_step_m;
    }
    return out;
}

}  // namespace sonarsim
