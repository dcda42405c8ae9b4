#include "calibrated/scatterers.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

using Floats = PieceBlock::Array<float>;
using Words = PieceBlock::Array<std::uint32_t>;

// Cells no longer than this share of the resolution in range: the scatterer's phase holds for all
// of the cell, which would otherwise show as speckle that is longer than the pulse.
constexpr double most_of_resolution = 0.75;

/// 32 bits that look random by 64 (the finaliser of MurmurHash3, put to the words in turn).
std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
    std::uint32_t h = a * 0x85EBCA6BU;
    h = (h ^ (h >> 15)) + b * 0xC2B2AE35U;
    h = (h ^ (h >> 16)) * 0x85EBCA6BU;
    h = (h ^ (h >> 13)) * 0xC2B2AE35U;
    return h ^ (h >> 16);
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

/// What the cells are called in their draws.
void name_cells(const Scatterers& block, int count, Words& low, Words& high) {
    constexpr std::uint32_t bits_21 = 0x1FFFFF;
    for (int k = 0; k < count; ++k) {
        const std::uint32_t split = word_of(block.cell[2][k]);
        low[k] = (word_of(block.cell[0][k]) & bits_21) | split << 21;
        // Levels differ in the exponent of the edge.
        high[k] = ((word_of(block.cell[1][k]) & bits_21) | split >> 11 << 21) ^
                  (std::bit_cast<std::uint32_t>(block.edge_m[k]) >> 23) * 0x9E3779B1U;
    }
}

/// The phase, in turns, of the sound that comes back from each cell's scatterer. The way is taken
/// in double: at 40 m and 2 MHz the last bit of a float is 0.07 rad.
void find_phases(const Scatterers& block, int count, const Words& jitter, const SonarInScene& sonar,
                 double turns_per_m, Floats& turns) {
    constexpr std::uint32_t bits_10 = 0x3FF;
    constexpr double step = 0x1p-10;
    const double sx = sonar.sensor.x();
    const double sy = sonar.sensor.y();
    const double sz = sonar.sensor.z();
    for (int k = 0; k < count; ++k) {
        const auto part = [&](std::uint32_t bits) {
            return (static_cast<double>(static_cast<std::int32_t>(bits & bits_10)) + 0.5) * step;
        };
        const double e = block.edge_m[k];
        const double x = (block.cell[0][k] + part(jitter[k])) * e - sx;
        const double y = (block.cell[1][k] + part(jitter[k] >> 10)) * e - sy;
        const double z = (block.cell[2][k] + part(jitter[k] >> 20)) * e - sz;
        const double way = turns_per_m * std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
        turns[k] = static_cast<float>(way - std::floor(way));
    }
}

/// A sample seen along an axis of the world: a parallelogram in the plane of the other two.
struct Projected {
    const Sample& sample;
    int axis, first, second;  ///< the axis, and the other two
    Eigen::Vector3d centre;   ///< relative to Scene::origin, m
    Eigen::Vector3f u, v;     ///< half edges, world frame
    float determinant;
    float area_by_projected;  ///< of the sample, by that of its projection
};

Projected project(const Sample& sample, const SonarInScene& sonar) {
    const Eigen::Vector3f u = sonar.R_world_sensor * sample.edge_u;
    const Eigen::Vector3f v = sonar.R_world_sensor * sample.edge_v;
    const Eigen::Vector3f normal = u.cross(v);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3f place = sonar.R_world_sensor * sample.position;
    return {sample,
            axis,
            (axis + 1) % 3,
            (axis + 2) % 3,
            sonar.sensor + place.cast<double>(),
            u,
            v,
            normal[axis],
            sample.area_m2 / (4.0F * std::fabs(normal[axis]))};
}

/// Cells that may have their point on a sample.
struct Candidates {
    static constexpr int most = 256;
    int count = 0;
    std::array<std::int32_t, most> i, j;
    std::array<std::uint32_t, most> level;
    std::array<float, most> edge;
    std::array<float, most> s, t;  ///< where a cell's point lies on the sample, in half edges

    void add(std::int32_t column, std::int32_t row, float edge_m, std::uint32_t name) {
        i[count] = column;
        j[count] = row;
        edge[count] = edge_m;
        level[count++] = name;
    }

    /// In plain loops over arrays, several cells at a time.
    void find_points(const Projected& p) {
        const double cx = p.centre[p.first];
        const double cy = p.centre[p.second];
        const float ux = p.u[p.first];
        const float uy = p.u[p.second];
        const float vx = p.v[p.first];
        const float vy = p.v[p.second];
        const std::uint32_t face = (p.axis + 1U) << 29;
        for (int k = 0; k < count; ++k) {
            const std::uint32_t h = mixed(word_of(i[k]) ^ level[k] << 27, word_of(j[k]) ^ face);
            const auto part_x = static_cast<std::int32_t>(h & 0xFFFFU);
            const auto part_y = static_cast<std::int32_t>(h >> 16);
            const auto x = static_cast<float>((i[k] + part_x * 0x1p-16) * edge[k] - cx);
            const auto y = static_cast<float>((j[k] + part_y * 0x1p-16) * edge[k] - cy);
            s[k] = (x * vy - y * vx) / p.determinant;
            t[k] = (y * ux - x * uy) / p.determinant;
        }
    }
};

/// Adds scatterers to a block.
struct Collector {
    Scatterers& block;
    const std::function<void(const Scatterers&)>& use;
    Candidates candidates{};

    /// Those of the candidates whose points lie on the sample.
    void take(const Projected& p) {
        candidates.find_points(p);
        for (int k = 0; k < candidates.count; ++k) {
            const float s = candidates.s[k];
            const float t = candidates.t[k];
            if (s >= -1.0F && s < 1.0F && t >= -1.0F && t < 1.0F) add(p, k, s, t);
        }
        candidates.count = 0;
    }

    void add(const Projected& p, int candidate, float s, float t) {
        const float edge = candidates.edge[candidate];
        PieceBlock& pieces = block.pieces;
        const int at = pieces.count++;
        const Sample& sample = p.sample;
        pieces.x[at] = sample.position.x() + s * sample.edge_u.x() + t * sample.edge_v.x();
        pieces.y[at] = sample.position.y() + s * sample.edge_u.y() + t * sample.edge_v.y();
        pieces.z[at] = sample.position.z() + s * sample.edge_u.z() + t * sample.edge_v.z();
        pieces.area_m2[at] = edge * edge * p.area_by_projected;
        pieces.height_m[at] = sample.height_m;
        pieces.material[at] = sample.material;
        block.edge_m[at] = edge;
        block.cell[p.first][at] = candidates.i[candidate];
        block.cell[p.second][at] = candidates.j[candidate];
        const double along = p.centre[p.axis] + s * p.u[p.axis] + t * p.v[p.axis];
        // Four cells high, the scatterer near the middle: samples of a curved surface are flat and
        // put it a little higher or lower each time, which must not make it another one.
        block.cell[p.axis][at] = 4 * static_cast<std::int32_t>(std::floor(0.25 * along / edge)) + 1;
        if (pieces.count == PieceBlock::most) flush();
    }

    void flush() {
        if (block.pieces.count > 0) use(block);
        block.pieces.count = 0;
    }
};

/// Where the points of a projected sample lie along its first axis, by where they lie along the
/// second: around a line, no further from it than `spread`.
struct Slant {
    double slope, spread;

    explicit Slant(const Projected& p) {
        // Along the edge that goes further along the second axis: not 0 while there is any area.
        const bool by_u = std::fabs(p.u[p.second]) >= std::fabs(p.v[p.second]);
        const Eigen::Vector3f& edge = by_u ? p.u : p.v;
        const Eigen::Vector3f& other = by_u ? p.v : p.u;
        slope = static_cast<double>(edge[p.first]) / edge[p.second];
        spread = std::fabs(other[p.first] - slope * other[p.second]);
    }
};

/// The cells of a projected sample. Between the ranges at which one level or the next is right,
/// part of the larger cells hold a scatterer each and the others are split; each does so at a range
/// of its own, so that the scatterers do not change all at once while the sonar moves.
void add_cells(const Projected& p, const ScattererCells& cells, Collector& collector) {
    const float range = p.sample.position.norm();
    const float root = cells.edge_per_root_range / cells.least_edge_m;
    const float ratio = std::max(root * root * range, 1.0F);
    const float wanted =
        std::min((0.5F / 0.69314718F) * natural_log(ratio), static_cast<float>(cells.levels - 1));
    const int level = static_cast<int>(std::floor(wanted));
    const float whole_cells = wanted - std::floor(wanted);
    const float fine = cells.edge_of(level);
    const float coarse = 2.0F * fine;
    const auto name = static_cast<std::uint32_t>(level);
    const auto cells_along = [&](int axis) {
        const double half = std::fabs(p.u[axis]) + std::fabs(p.v[axis]);
        return std::array{static_cast<std::int32_t>(std::floor((p.centre[axis] - half) / coarse)),
                          static_cast<std::int32_t>(std::floor((p.centre[axis] + half) / coarse))};
    };
    const auto columns = cells_along(p.first);
    const auto rows = cells_along(p.second);
    const Slant slant(p);
    Candidates& candidates = collector.candidates;
    const double beside = slant.spread + 1e-3 * coarse;  // the latter for rounding
    for (std::int32_t j = rows[0]; j <= rows[1]; ++j) {
        const double one = slant.slope * (j * static_cast<double>(coarse) - p.centre[p.second]);
        const double other = one + slant.slope * coarse;
        const double low = p.centre[p.first] + std::min(one, other) - beside;
        const double high = p.centre[p.first] + std::max(one, other) + beside;
        const double first = std::max(std::floor(low / coarse), static_cast<double>(columns[0]));
        const double last = std::min(std::floor(high / coarse), static_cast<double>(columns[1]));
        for (auto i = static_cast<std::int32_t>(first); i <= last; ++i) {
            const std::uint32_t h = mixed(word_of(i) ^ 0x5bd1e995U, word_of(j) ^ name << 27);
            if (candidates.count + 4 > Candidates::most) collector.take(p);
            if (unit_float(h) < whole_cells) {
                candidates.add(i, j, coarse, name + 1);
                continue;
            }
            candidates.add(2 * i, 2 * j, fine, name);
            candidates.add(2 * i + 1, 2 * j, fine, name);
            candidates.add(2 * i, 2 * j + 1, fine, name);
            candidates.add(2 * i + 1, 2 * j + 1, fine, name);
        }
    }
    collector.take(p);
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

void find_scatterers(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use) {
    Collector collector{block, use};
    block.pieces.count = 0;
    for (const Sample& sample : samples) {
        const Projected projected = project(sample, sonar);
        if (projected.determinant == 0.0F) continue;
        add_cells(projected, cells, collector);
    }
    collector.flush();
}

void draw_amplitudes(const Scatterers& block, const PointEchoes& echoes,
                     const ScattererCells& cells, const SonarInScene& sonar, PhiloxKey key,
                     Amplitudes& out) {
    Floats turns;
    Words draw, jitter;
    const int count = echoes.count;
    name_cells(block, count, draw, jitter);
    philox_pairs(draw.data(), jitter.data(), count, key);
    find_phases(block, count, jitter, sonar, cells.turns_per_m, turns);
    for (int k = 0; k < count; ++k) {
        // Of the first word 20 bits make the strength, which is exponential, and 12 the phase.
        const auto upper = static_cast<float>(static_cast<std::int32_t>(draw[k] >> 12));
        const auto lower = static_cast<float>(static_cast<std::int32_t>(draw[k] & 0xFFFU));
        const float strength = -natural_log((upper + 0.5F) * 0x1p-20F);
        const float amplitude = std::sqrt(echoes.power[k] * strength);
        const SinCosFloat phase = sincos_turns(std::fma(lower, 0x1p-12F, turns[k]));
        out.re[k] = amplitude * phase.cos;
        out.im[k] = amplitude * phase.sin;
    }
}

}  // namespace sonarsim
