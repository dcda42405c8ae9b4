#include "calibrate/noise_fit.h"

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr int groups_of_beams = 8;
// A block is on the law if it is within this many dB of it.
constexpr double near_db = 0.8;
constexpr std::size_t least_blocks = 6;
constexpr double least_share = 0.12;
// The level of speckle is accurate to this many dB at best, because of the trend within a block and
// the law's error.
constexpr double least_level_db = 0.1;

/// The sums over the values of one block of one ping and the next one.
struct BlockSums {
    double count = 0.0, zeros = 0.0, log_sum = 0.0, log_square = 0.0;
    double pairs = 0.0, log_difference = 0.0, powers = 0.0, power_difference = 0.0;
    double group_sum[groups_of_beams] = {}, group_count[groups_of_beams] = {};
};

void add_pair(double log_a, double log_b, BlockSums& sums) {
    const double a = exponential(log_a);
    const double b = exponential(log_b);
    sums.pairs += 1.0;
    sums.log_difference += (log_a - log_b) * (log_a - log_b);
    sums.powers += 0.5 * (a + b);
    sums.power_difference += (a - b) * (a - b);
}

BlockSums block_sums(const Recording& recording, const LawFit& law, double full_value,
                     const AheadBeams& ahead, int row) {
    BlockSums sums;
    for (std::size_t k = 0; k < recording.pings.size(); ++k) {
        const RecordedPing& ping = recording.pings[k];
        const RecordedPing* next =
            k + 1 < recording.pings.size() ? &recording.pings[k + 1] : nullptr;
        if (row + rows_of_noise_block > ping.ranges) continue;
        for (int i = row; i < row + rows_of_noise_block; ++i) {
            for (int j = 0; j < ping.beams; ++j) {
                if (ahead.holds(j)) continue;
                const std::size_t at =
                    static_cast<std::size_t>(i) * static_cast<std::size_t>(ping.beams) +
                    static_cast<std::size_t>(j);
                const double value = ping.values[at];
                const double log_power = law.log_power(value, full_value);
                const int group = j * groups_of_beams / ping.beams;
                sums.count += 1.0;
                sums.zeros += value <= 0.0 ? 1.0 : 0.0;
                sums.log_sum += log_power;
                sums.log_square += log_power * log_power;
                sums.group_sum[group] += log_power;
                sums.group_count[group] += 1.0;
                if (next && next->values.size() == ping.values.size())
                    add_pair(log_power, law.log_power(next->values[at], full_value), sums);
            }
        }
    }
    return sums;
}

/// The spread of the mean log powers of groups of beams: 1.48 times the median distance from their
/// median, so that one group with a bright point does not count. The two middle groups are left
/// out, since they contain the noise that all elements share.
double spread_of_groups(const BlockSums& sums) {
    std::vector<double> means;
    for (int g = 0; g < groups_of_beams; ++g) {
        const bool middle = g == groups_of_beams / 2 || g == groups_of_beams / 2 - 1;
        if (sums.group_count[g] > 0.0 && !middle)
            means.push_back(sums.group_sum[g] / sums.group_count[g]);
    }
    if (means.size() < 3) return 0.0;
    const auto median = [](std::vector<double>& values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    };
    const double middle = median(means);
    for (double& mean : means)
        mean = std::fabs(mean - middle);
    return 1.48 * median(means);
}

NoiseBlock block_of(const BlockSums& sums, const LawFit& law, int row, double range_m) {
    NoiseBlock out{.row = row, .range_m = range_m};
    const double expected = law.statistics.variance;
    const double mean = sums.log_sum / sums.count;
    out.level_db = db_of_e * (mean - law.statistics.mean);
    out.homogeneous = sums.zeros < 0.003 * sums.count;
    if (sums.pairs > 0.0) {
        // The difference of independent log powers has twice their variance.
        const double kept = 1.0 - 0.5 * sums.log_difference / sums.pairs / expected;
        const double power = sums.powers / sums.pairs;
        const double half = 0.5 * sums.power_difference / sums.pairs;
        if (kept > 0.25 && half < 0.75 * power * power) {
            if (law.statistics.looks > 1 || !law.statistics.excess.empty()) {
                out.homogeneous = false;
                return out;
            }
            const double fresh = power - std::sqrt(power * power - half);
            out.level_db = db_of_e * logarithm(fresh);
            return out;
        }
    }
    out.without_echo = true;
    const double independent = sums.count / groups_of_beams / 6.0;
    out.homogeneous =
        out.homogeneous &&
        spread_of_groups(sums) < 0.3 + 3.0 * std::sqrt(expected / std::max(independent, 1.0));
    return out;
}

struct Shape {
    double log_factor, from_m;
};

double gain_of(const Shape& shape, double absorption_db_per_m, double range_m) {
    const double r = std::max(range_m, shape.from_m);
    return shape.log_factor * 0.1 * db_of_power(r) + 2.0 * absorption_db_per_m * r;
}

struct Candidate {
    Shape shape{};
    double level_db = 0.0, score = -1e30;
};

/// The level with the greatest number of blocks near the shape less the number of those below it.
Candidate best_level(const std::vector<NoiseBlock>& blocks, double absorption_db_per_m,
                     const Shape& shape) {
    std::vector<double> offsets;
    for (const NoiseBlock& block : blocks) {
        if (block.homogeneous)
            offsets.push_back(block.level_db - gain_of(shape, absorption_db_per_m, block.range_m));
    }
    std::sort(offsets.begin(), offsets.end());
    Candidate best{.shape = shape};
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < offsets.size(); ++begin) {
        while (end < offsets.size() && offsets[end] <= offsets[begin] + 2.0 * near_db)
            ++end;
        const double score = static_cast<double>(end - begin) - static_cast<double>(begin);
        if (score > best.score) {
            best.score = score;
            best.level_db = 0.5 * (offsets[begin] + offsets[end - 1]);
        }
    }
    return best;
}

/// Least squares of level and log factor for the blocks with these weights.
Candidate least_squares(const std::vector<NoiseBlock>& blocks, double absorption_db_per_m,
                        double from_m, const std::vector<double>& weights) {
    double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const double r = std::max(blocks[k].range_m, from_m);
        const double at = 0.1 * db_of_power(r);
        const double level = blocks[k].level_db - 2.0 * absorption_db_per_m * r;
        w += weights[k];
        x += weights[k] * at;
        y += weights[k] * level;
        xx += weights[k] * at * at;
        xy += weights[k] * at * level;
    }
    Candidate out;
    out.shape = {(xy - x * y / w) / (xx - x * x / w), from_m};
    out.level_db = (y - out.shape.log_factor * x) / w;
    double error = 0.0;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const double off = blocks[k].level_db - out.level_db -
                           gain_of(out.shape, absorption_db_per_m, blocks[k].range_m);
        error += weights[k] * off * off;
    }
    out.score = -error;
    return out;
}

/// The step between the starts of starts_of(), as a share of the farthest range.
constexpr double start_step = 0.02;

/// The ranges at which the gain may begin to grow: 0, and those of the nearest blocks.
std::vector<double> starts_of(const std::vector<NoiseBlock>& blocks) {
    std::vector<double> out{0.0};
    if (blocks.empty()) return out;
    const double first = 1.4 * blocks.front().range_m;
    const double step = start_step * blocks.back().range_m;
    for (int k = 0; first + k * step < 20.0 * step; ++k)
        out.push_back(first + k * step);
    return out;
}

/// A finer grid about a start of starts_of(), whose steps would bend the law by up to a decibel.
std::vector<double> starts_about(double from_m, double farthest_m) {
    if (from_m == 0.0) return {0.0};
    std::vector<double> out;
    for (int k = -10; k <= 10; ++k)
        out.push_back(std::max(from_m + 0.1 * k * start_step * farthest_m, 0.0));
    return out;
}

Candidate lowest_law(const std::vector<NoiseBlock>& blocks, double absorption_db_per_m) {
    Candidate best;
    for (const double from_m : starts_of(blocks)) {
        for (int log_factor = 0; log_factor <= 60; ++log_factor) {
            Candidate here = best_level(blocks, absorption_db_per_m, {1.0 * log_factor, from_m});
            // A start above 0 must gain at least three blocks.
            if (from_m > 0.0) here.score -= 3.0;
            if (here.score > best.score) best = here;
        }
    }
    return best;
}

std::vector<NoiseBlock> blocks_near(const std::vector<NoiseBlock>& blocks,
                                    double absorption_db_per_m, const Candidate& law,
                                    double within_db) {
    std::vector<NoiseBlock> out;
    for (const NoiseBlock& block : blocks) {
        const double off =
            block.level_db - law.level_db - gain_of(law.shape, absorption_db_per_m, block.range_m);
        if (block.homogeneous && std::fabs(off) <= within_db) out.push_back(block);
    }
    return out;
}

}  // namespace

std::vector<NoiseBlock> noise_blocks(const Recording& recording, const LawFit& law,
                                     const AheadBeams& ahead) {
    std::vector<NoiseBlock> out;
    const double full_value = full_value_of(recording);
    for (int row = 0; row + rows_of_noise_block <= recording.pings.front().ranges;
         row += rows_of_noise_block) {
        const double middle = row + 0.5 * (rows_of_noise_block - 1);
        const double range_m = recording.first_range_m + middle * recording.range_step_m;
        const BlockSums sums = block_sums(recording, law, full_value, ahead, row);
        if (sums.count == 0.0 || range_m <= 0.0) continue;
        out.push_back(block_of(sums, law, row, range_m));
        out.back().without_zeros = !law.cuts_off(power_of_db(out.back().level_db), full_value);
    }
    return out;
}

double NoiseFit::at(double range_m) const {
    return level_db.value +
           gain_of({tvg_log.value, tvg_from_m.value}, absorption_db_per_m, range_m);
}

std::optional<NoiseFit> fit_noise(const std::vector<NoiseBlock>& blocks,
                                  double absorption_db_per_m) {
    Candidate law = lowest_law(blocks, absorption_db_per_m);
    std::vector<NoiseBlock> used = blocks_near(blocks, absorption_db_per_m, law, near_db);
    const double least = least_share * static_cast<double>(blocks.size());
    if (used.size() < least_blocks || static_cast<double>(used.size()) < least) return {};
    const auto best_fit = [&](const std::vector<double>& weights) {
        Candidate best;
        for (const double from_m : starts_about(law.shape.from_m, blocks.back().range_m)) {
            const Candidate here = least_squares(used, absorption_db_per_m, from_m, weights);
            if (here.score > best.score) best = here;
        }
        return best;
    };
    for (int round = 0; round < 5; ++round) {
        law = best_fit(std::vector<double>(used.size(), 1.0));
        used = blocks_near(blocks, absorption_db_per_m, law, 1.2 * near_db);
        if (used.size() < least_blocks) return {};
    }
    const auto fitted = [&](const std::vector<double>& weights) {
        const Candidate best = best_fit(weights);
        return std::vector<double>{best.level_db, best.shape.log_factor, best.shape.from_m};
    };
    const std::vector<Bounded> found = bootstrap_all(
        static_cast<int>(used.size()), fitted,
        {least_level_db, 0.2, law.shape.from_m > 0.0 ? start_step * used.back().range_m : 0.0});
    return NoiseFit{.level_db = found[0],
                    .tvg_log = found[1],
                    .tvg_from_m = found[2],
                    .used = used,
                    .common_mode_db = {-300.0, -300.0, -300.0},
                    .ahead = {},
                    .absorption_db_per_m = absorption_db_per_m};
}

}  // namespace sonarsim
