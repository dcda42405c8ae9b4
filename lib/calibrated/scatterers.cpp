#include "calibrated/scatterers.h"

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"

namespace sonarsim {

namespace {

using Floats = PieceBlock::Array<float>;
using Words = PieceBlock::Array<std::uint32_t>;

// Cells no longer than this share of the resolution in range: the scatterer's phase holds for all
// of the cell, which would otherwise show as speckle that is longer than the pulse.
constexpr double most_of_resolution = 0.75;

/// What surface lies in a cube that a plane cuts at random, on average over the directions of the
/// plane and weighted by area: mean of the squared area by mean area, in squared edges. Integrated
/// numerically; it is 1 for a plane along a face and 0.89 across a diagonal.
constexpr float area_in_cell = 0.93F;

/// 32 bits that look random by 64 (the finaliser of MurmurHash3, put to the words in turn).
std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
    std::uint32_t h = a * 0x85EBCA6BU;
    h = (h ^ (h >> 15)) + b * 0xC2B2AE35U;
    h = (h ^ (h >> 16)) * 0x85EBCA6BU;
    h = (h ^ (h >> 13)) * 0xC2B2AE35U;
    return h ^ (h >> 16);
}

/// How much stronger the pieces of a cell are together, by the mean of the squared number of them
/// that have their middle in it: where q pieces go into an edge, q rounded up or down.
float crowding(float edge, float length) {
    const float q = std::max(edge / length, 1.0F);
    const float part = q - std::floor(q);
    return 1.0F + part * (1.0F - part) / (q * q);
}

struct WorldPlaces {
    Floats x, y, z;  ///< relative to Scene::origin, m
};

void find_places(const PieceBlock& pieces, int count, const SonarInScene& sonar, WorldPlaces& out) {
    const Eigen::Matrix3f& R = sonar.R_world_sensor;
    const Eigen::Vector3f s = sonar.sensor.cast<float>();
    const auto place = [&](int axis, Floats& to) {
        const float rx = R(axis, 0);
        const float ry = R(axis, 1);
        const float rz = R(axis, 2);
        const float base = s[axis];
        for (int k = 0; k < count; ++k) {
            to[k] = std::fma(rx, pieces.x[k],
                             std::fma(ry, pieces.y[k], std::fma(rz, pieces.z[k], base)));
        }
    };
    place(0, out.x);
    place(1, out.y);
    place(2, out.z);
}

std::uint32_t word_of(std::int32_t x) {
    return static_cast<std::uint32_t>(x);
}

std::int32_t cell_along(float metres, float per_edge) {
    return static_cast<std::int32_t>(std::floor(metres * per_edge));
}

/// The level of each piece's cell. Between the ranges at which one level or the next is right, part
/// of the larger cells hold a scatterer each and the others are split; each does so at a range of
/// its own, so that the scatterers do not change all at once while the sonar moves.
void find_levels(const PointEchoes& echoes, const ScattererCells& cells, const WorldPlaces& places,
                 Floats& edge) {
    const float root = cells.edge_per_root_range / cells.least_edge_m;
    const float square = root * root;
    const auto last = static_cast<float>(cells.levels - 1);
    for (int k = 0; k < echoes.count; ++k) {
        // The edge that is wanted is least_edge 2^wanted.
        const float ratio = std::max(square * echoes.range_m[k], 1.0F);
        const float wanted = std::min((0.5F / 0.69314718F) * natural_log(ratio), last);
        const float level = std::floor(wanted);
        const float fine = cells.least_edge_m *
                           std::bit_cast<float>((static_cast<std::int32_t>(level) + 127) << 23);
        const float per_coarse = 0.5F / fine;
        const std::uint32_t h = mixed(word_of(cell_along(places.x[k], per_coarse)) ^
                                          word_of(cell_along(places.z[k], per_coarse)) << 16,
                                      word_of(cell_along(places.y[k], per_coarse)) ^
                                          word_of(static_cast<std::int32_t>(level)) << 24);
        edge[k] = unit_float(h) < wanted - level ? 2.0F * fine : fine;
    }
}

struct CellNumbers {
    PieceBlock::Array<std::int32_t> x, y, z;
};

void find_cells(const WorldPlaces& places, int count, const Floats& edge, CellNumbers& cells,
                Words& low, Words& high) {
    for (int k = 0; k < count; ++k) {
        const float per_edge = 1.0F / edge[k];
        cells.x[k] = cell_along(places.x[k], per_edge);
        cells.y[k] = cell_along(places.y[k], per_edge);
        cells.z[k] = cell_along(places.z[k], per_edge);
        constexpr std::uint32_t bits_21 = 0x1FFFFF;
        const std::uint32_t split = word_of(cells.z[k]);
        low[k] = (word_of(cells.x[k]) & bits_21) | split << 21;
        // Levels differ in the exponent of the edge.
        high[k] = ((word_of(cells.y[k]) & bits_21) | split >> 11 << 21) ^
                  (std::bit_cast<std::uint32_t>(edge[k]) >> 23) * 0x9E3779B1U;
    }
}

/// The phase, in turns, of the sound that comes back from each cell's scatterer. The way is taken
/// in double: at 40 m and 2 MHz the last bit of a float is 0.07 rad.
void find_phases(const CellNumbers& cells, int count, const Floats& edge, const Words& jitter,
                 const SonarInScene& sonar, double turns_per_m, Floats& turns) {
    constexpr std::uint32_t bits_10 = 0x3FF;
    constexpr double step = 0x1p-10;
    const double sx = sonar.sensor.x();
    const double sy = sonar.sensor.y();
    const double sz = sonar.sensor.z();
    for (int k = 0; k < count; ++k) {
        const auto part = [&](std::uint32_t bits) {
            return (static_cast<double>(static_cast<std::int32_t>(bits & bits_10)) + 0.5) * step;
        };
        const double e = edge[k];
        const double x = (cells.x[k] + part(jitter[k])) * e - sx;
        const double y = (cells.y[k] + part(jitter[k] >> 10)) * e - sy;
        const double z = (cells.z[k] + part(jitter[k] >> 20)) * e - sz;
        const double way = turns_per_m * std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
        turns[k] = static_cast<float>(way - std::floor(way));
    }
}

/// The regularised lower incomplete gamma function P(a, x), by its series or its continued fraction
/// (e.g. Abramowitz and Stegun 6.5.29 and 6.5.31). `log_gamma` is ln Gamma(a).
double gamma_probability(double a, double x, double log_gamma) {
    if (x <= 0.0) return 0.0;
    const double factor = exponential(a * logarithm(x) - x - log_gamma);
    if (x < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (int n = 1; n < 500; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return factor * sum;
    }
    double tail = 0.0;
    for (int n = 200; n >= 1; --n)
        tail = n * (n - a) / (x + 2.0 * n + 1.0 - a - tail);
    return 1.0 - factor / (x + 1.0 - a - tail);
}

/// ln Gamma(a) of a > 0, by Stirling's series at a + 10.
double log_gamma(double a) {
    double product = 1.0;
    for (int n = 0; n < 10; ++n)
        product *= a + n;
    const double b = a + 10.0;
    const double series =
        1.0 / (12.0 * b) - 1.0 / (360.0 * b * b * b) + 1.0 / (1260.0 * b * b * b * b * b);
    return (b - 0.5) * logarithm(b) - b + 0.5 * logarithm(2.0 * pi) + series - logarithm(product);
}

}  // namespace

ScattererCells scatterer_cells(double per_cell, double resolution_m, double width_rad,
                               double range_min_m, double wavelength_m) {
    const double greatest = most_of_resolution * resolution_m;
    const double per_root_range = std::sqrt(resolution_m * width_rad / per_cell);
    const double least = per_root_range * std::sqrt(std::max(range_min_m, 1e-3));
    ScattererCells out;
    out.levels = 1;
    double edge = greatest;
    while (edge > least && out.levels < 12) {
        edge *= 0.5;
        ++out.levels;
    }
    out.least_edge_m = static_cast<float>(edge);
    out.edge_per_root_range = static_cast<float>(per_root_range);
    out.turns_per_m = 2.0 / wavelength_m;
    return out;
}

Clutter gamma_clutter(double shape, double edge_m) {
    Clutter out;
    if (shape <= 0.0) return out;
    out.edge_m = static_cast<float>(edge_m);
    const double log_gamma_of_shape = log_gamma(shape);
    double mean = 0.0;
    for (int k = 0; k < Clutter::steps; ++k) {
        const double probability = (k + 0.5) / Clutter::steps;
        double low = 0.0;
        double high = shape + 40.0 * std::sqrt(shape) + 40.0;
        for (int n = 0; n < 60; ++n) {
            const double middle = 0.5 * (low + high);
            const bool below = gamma_probability(shape, middle, log_gamma_of_shape) < probability;
            (below ? low : high) = middle;
        }
        out.strength.push_back(static_cast<float>(low));
        mean += low / Clutter::steps;
    }
    for (float& strength : out.strength)
        strength = static_cast<float>(strength / mean);
    return out;
}

void add_clutter(const PieceBlock& pieces, const Clutter& clutter, const SonarInScene& sonar,
                 PhiloxKey key, PointEchoes& echoes) {
    if (clutter.strength.empty()) return;
    WorldPlaces places;
    find_places(pieces, echoes.count, sonar, places);
    const float per_edge = 1.0F / clutter.edge_m;
    for (int k = 0; k < echoes.count; ++k) {
        const std::uint32_t h = mixed(word_of(cell_along(places.x[k], per_edge)) ^
                                          word_of(cell_along(places.z[k], per_edge)) << 16 ^ key.k0,
                                      word_of(cell_along(places.y[k], per_edge)) ^ key.k1);
        echoes.power[k] *= clutter.strength[h >> 22];
    }
}

void draw_amplitudes(const PieceBlock& pieces, const PointEchoes& echoes,
                     const ScattererCells& cells, const SonarInScene& sonar, PhiloxKey key,
                     Amplitudes& out) {
    WorldPlaces places;
    Floats edge, turns;
    CellNumbers numbers;
    Words draw, jitter;
    const int count = echoes.count;
    find_places(pieces, count, sonar, places);
    find_levels(echoes, cells, places, edge);
    find_cells(places, count, edge, numbers, draw, jitter);
    philox_pairs(draw.data(), jitter.data(), count, key);
    find_phases(numbers, count, edge, jitter, sonar, cells.turns_per_m, turns);
    for (int k = 0; k < count; ++k) {
        // Of the first word 20 bits make the strength, which is exponential, and 12 the phase.
        const auto upper = static_cast<float>(static_cast<std::int32_t>(draw[k] >> 12));
        const auto lower = static_cast<float>(static_cast<std::int32_t>(draw[k] & 0xFFFU));
        const float strength = -natural_log((upper + 0.5F) * 0x1p-20F);
        const float area = pieces.area_m2[k];
        const float crowd =
            crowding(edge[k], pieces.length_u[k]) * crowding(edge[k], pieces.length_v[k]);
        const float whole = std::max(area_in_cell * crowd * edge[k] * edge[k], area);
        const float amplitude = std::sqrt(echoes.power[k] * strength * (area / whole));
        const SinCosFloat phase = sincos_turns(std::fma(lower, 0x1p-12F, turns[k]));
        out.re[k] = amplitude * phase.cos;
        out.im[k] = amplitude * phase.sin;
    }
}

}  // namespace sonarsim
