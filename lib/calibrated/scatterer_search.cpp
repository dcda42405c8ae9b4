#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "calibrated/scatterers.h"
#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr int search_lanes = 8;

// Head-on a resolution cell has no end on the surface: its length is taken to be this many times
// that of the pulse at the most. With more, objects of a few centimetres would hold few scatterers.
constexpr float longest_on_surface = 2.0F;

/// 32 bits that look random by 64 (the finaliser of MurmurHash3, put to the words in turn).
__m256i mixed(__m256i a, __m256i b) {
    const __m256i one = _mm256_set1_epi32(static_cast<int>(0x85EBCA6BU));
    const __m256i other = _mm256_set1_epi32(static_cast<int>(0xC2B2AE35U));
    __m256i h = _mm256_mullo_epi32(a, one);
    h = _mm256_xor_si256(h, _mm256_srli_epi32(h, 15));
    h = _mm256_add_epi32(h, _mm256_mullo_epi32(b, other));
    h = _mm256_mullo_epi32(_mm256_xor_si256(h, _mm256_srli_epi32(h, 16)), one);
    h = _mm256_mullo_epi32(_mm256_xor_si256(h, _mm256_srli_epi32(h, 13)), other);
    return _mm256_xor_si256(h, _mm256_srli_epi32(h, 16));
}

/// The numbers of the bits that are set, in order.
__m256i order_of(unsigned mask) {
    const std::uint64_t bytes = _pdep_u64(mask, 0x0101010101010101U) * 0xFFU;
    const std::uint64_t numbers = _pext_u64(0x0706050403020100U, bytes);
    return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(numbers)));
}

/// The edge that cells should have where a surface is seen from a range at a grazing angle of
/// `sine`, squared. A resolution cell is longer on the surface than in range by one over the cosine
/// of that angle, and cells are larger by as much.
float wanted_edge2(const ScattererCells& cells, float range, float sine) {
    const float cosine2 = 1.0F - sine * sine;
    const float longer2 =
        std::min(1.0F / std::max(cosine2, 1e-6F), longest_on_surface * longest_on_surface);
    const float grazing2 = cells.edge_per_root_range * cells.edge_per_root_range * range;
    const float depth2 = cells.greatest_depth_m * cells.greatest_depth_m;
    const float width = cells.width_rad * range;
    // No wider than a beam where it is length that makes them larger.
    return std::min({grazing2 * std::sqrt(longer2), depth2 * longer2,
                     std::max(std::min(grazing2, depth2), width * width)});
}

/// A sample among the cells at its range, seen along an axis of the world: a parallelogram in the
/// plane of the other two. Between the ranges at which one level or the next is right, part of the
/// larger cells hold a scatterer each and the others are split. Lengths are in edges of the smaller
/// cells, from a corner near the sample, so that floats hold them.
struct Footprint {
    const Sample& sample;
    int axis, first, second;  ///< the axis, and the other two
    std::array<std::int32_t, 3>
        base;                      ///< the corner: numbers of smaller cells, each a multiple of 8
    Eigen::Vector3f centre, u, v;  ///< of the parallelogram, and half its edges
    float s_x, s_y, t_x, t_y;      ///< from a place off the centre to shares of u and v
    float fine_m;                  ///< edge of the smaller cells
    float area_by_projected;       ///< of the sample, by that of its projection
    std::uint32_t level;           ///< of the smaller cells
    float whole_cells;             ///< share of the larger ones that are not split
};

Footprint footprint_of(const Sample& sample, const ScattererCells& cells,
                       const SonarInScene& sonar) {
    const Eigen::Vector3f u = sonar.R_world_sensor * sample.edge_u;
    const Eigen::Vector3f v = sonar.R_world_sensor * sample.edge_v;
    const Eigen::Vector3f normal = u.cross(v);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const float range = sample.position.norm();
    const float edge2 = wanted_edge2(cells, range, std::min(sample.height_m / range, 1.0F));
    const float ratio = std::max(edge2 / (cells.least_edge_m * cells.least_edge_m), 1.0F);
    const float wanted =
        std::min((0.5F / 0.69314718F) * natural_log(ratio), static_cast<float>(cells.levels - 1));
    const float level = std::floor(wanted);
    Footprint out{sample,
                  axis,
                  first,
                  second,
                  {},
                  {},
                  {},
                  {},
                  0.0F,
                  0.0F,
                  0.0F,
                  0.0F,
                  cells.edge_of(static_cast<int>(level)),
                  sample.area_m2 / (4.0F * std::fabs(normal[axis])),
                  static_cast<std::uint32_t>(level),
                  wanted - level};
    const double per_edge = 1.0 / out.fine_m;
    const Eigen::Vector3d place =
        sonar.sensor + (sonar.R_world_sensor * sample.position).cast<double>();
    for (int k = 0; k < 3; ++k) {
        const double at = place[k] * per_edge;
        out.base[k] = 8 * static_cast<std::int32_t>(std::floor(0.125 * at));
        out.centre[k] = static_cast<float>(at - out.base[k]);
    }
    const auto per_edge_float = static_cast<float>(per_edge);
    out.u = per_edge_float * u;
    out.v = per_edge_float * v;
    const float per_area = 1.0F / (out.u[first] * out.v[second] - out.u[second] * out.v[first]);
    out.s_x = out.v[second] * per_area;
    out.s_y = -out.v[first] * per_area;
    out.t_x = -out.u[second] * per_area;
    out.t_y = out.u[first] * per_area;
    return out;
}

/// Where the points of a footprint lie along its first axis, by where they lie along the second:
/// around a line, no further from it than `spread`.
struct Slant {
    double slope, spread;

    explicit Slant(const Footprint& p) {
        // Along the edge that goes further along the second axis: not 0 while there is any area.
        const bool by_u = std::fabs(p.u[p.second]) >= std::fabs(p.v[p.second]);
        const Eigen::Vector3f& edge = by_u ? p.u : p.v;
        const Eigen::Vector3f& other = by_u ? p.v : p.u;
        slope = static_cast<double>(edge[p.first]) / edge[p.second];
        spread = std::fabs(other[p.first] - slope * other[p.second]);
    }
};

/// Cells of one level, eight at a time, of which some are asked for.
struct AskedCells {
    __m256i i, j;  ///< numbers along the first and the second axis
    __m256 x, y;   ///< corners off the centre of the footprint, in smaller cells
    __m256 size;   ///< edge, in smaller cells
    float edge_m;
    std::uint32_t level;
    unsigned asked;  ///< a bit for each
};

/// Finds the cells whose points lie on samples and makes scatterers of them.
class Search {
  public:
    Search(Scatterers& block, const std::function<void(const Scatterers&)>& use)
        : block_(block), use_(use) {
        block_.pieces.count = 0;
    }

    void add(const Footprint& p);
    void flush() {
        if (block_.pieces.count > 0) use_(block_);
        block_.pieces.count = 0;
        filled_ = 0;
    }

  private:
    static constexpr int most_listed = 256;

    void look_at_listed(const Footprint& p);
    void look_at(const Footprint& p, const AskedCells& cells);
    void fill(const Footprint& p);

    Scatterers& block_;
    const std::function<void(const Scatterers&)>& use_;
    PieceBlock::Array<float> s_{}, t_{};  ///< where scatterers lie on their sample, in half edges
    int filled_ = 0;                      ///< so many scatterers of the block are complete
    // Larger cells that the sample may lie on, by how far they are from the base.
    int listed_ = 0;
    std::array<std::int32_t, most_listed + search_lanes> column_{}, row_{};
};

void Search::add(const Footprint& p) {
    const auto cells_along = [&](int axis) {
        const float half = std::fabs(p.u[axis]) + std::fabs(p.v[axis]);
        return std::array{static_cast<std::int32_t>(std::floor(0.5F * (p.centre[axis] - half))),
                          static_cast<std::int32_t>(std::floor(0.5F * (p.centre[axis] + half)))};
    };
    const auto columns = cells_along(p.first);
    const auto rows = cells_along(p.second);
    const Slant slant(p);
    const double beside = slant.spread + 2e-3;  // the latter for rounding
    for (std::int32_t j = rows[0]; j <= rows[1]; ++j) {
        const double one = slant.slope * (2.0 * j - p.centre[p.second]);
        const double other = one + 2.0 * slant.slope;
        const double low = p.centre[p.first] + std::min(one, other) - beside;
        const double high = p.centre[p.first] + std::max(one, other) + beside;
        const double first = std::max(std::floor(0.5 * low), static_cast<double>(columns[0]));
        const double last = std::min(std::floor(0.5 * high), static_cast<double>(columns[1]));
        for (auto i = static_cast<std::int32_t>(first); i <= last; ++i) {
            if (listed_ == most_listed) look_at_listed(p);
            column_[listed_] = i;
            row_[listed_++] = j;
        }
    }
    look_at_listed(p);
    fill(p);
}

/// The larger cells are split or not, and hold a scatterer each or four.
void Search::look_at_listed(const Footprint& p) {
    const __m256i base_i = _mm256_set1_epi32(p.base[p.first] / 2);
    const __m256i base_j = _mm256_set1_epi32(p.base[p.second] / 2);
    const __m256 cx = _mm256_set1_ps(p.centre[p.first]);
    const __m256 cy = _mm256_set1_ps(p.centre[p.second]);
    const __m256 two = _mm256_set1_ps(2.0F);
    const __m256i salt = _mm256_set1_epi32(0x5bd1e995);
    const __m256i name = _mm256_set1_epi32(static_cast<int>(p.level << 27));
    for (int k = 0; k < listed_; k += search_lanes) {
        const auto load = [&](const auto& from) {
            return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from.data() + k));
        };
        const __m256i column = load(column_);
        const __m256i row = load(row_);
        const __m256i i = _mm256_add_epi32(base_i, column);
        const __m256i j = _mm256_add_epi32(base_j, row);
        const __m256 x = _mm256_fmsub_ps(two, _mm256_cvtepi32_ps(column), cx);
        const __m256 y = _mm256_fmsub_ps(two, _mm256_cvtepi32_ps(row), cy);
        const unsigned meant = listed_ - k >= search_lanes ? 0xFFU : (1U << (listed_ - k)) - 1U;
        const __m256i h = mixed(_mm256_xor_si256(i, salt), _mm256_xor_si256(j, name));
        const __m256 unit =
            _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_srli_epi32(h, 8)), _mm256_set1_ps(0x1p-24F));
        const auto whole = static_cast<unsigned>(
            _mm256_movemask_ps(_mm256_cmp_ps(unit, _mm256_set1_ps(p.whole_cells), _CMP_LT_OQ)));
        look_at(p, {i, j, x, y, two, 2.0F * p.fine_m, p.level + 1, meant & whole});
        for (int part = 0; part < 4; ++part) {
            const int right = part & 1;
            const int up = part >> 1;
            look_at(p, {_mm256_add_epi32(_mm256_add_epi32(i, i), _mm256_set1_epi32(right)),
                        _mm256_add_epi32(_mm256_add_epi32(j, j), _mm256_set1_epi32(up)),
                        _mm256_add_ps(x, _mm256_set1_ps(static_cast<float>(right))),
                        _mm256_add_ps(y, _mm256_set1_ps(static_cast<float>(up))),
                        _mm256_set1_ps(1.0F), p.fine_m, p.level, meant & ~whole});
        }
    }
    listed_ = 0;
}

/// Every cell has one point, by its number. Those whose point lies on the sample become scatterers.
void Search::look_at(const Footprint& p, const AskedCells& cells) {
    if (cells.asked == 0) return;
    const __m256i h =
        mixed(_mm256_xor_si256(cells.i, _mm256_set1_epi32(static_cast<int>(cells.level << 27))),
              _mm256_xor_si256(cells.j, _mm256_set1_epi32((p.axis + 1) << 29)));
    const __m256 step = _mm256_mul_ps(cells.size, _mm256_set1_ps(0x1p-16F));
    const __m256i low_half = _mm256_and_si256(h, _mm256_set1_epi32(0xFFFF));
    const __m256 x = _mm256_fmadd_ps(_mm256_cvtepi32_ps(low_half), step, cells.x);
    const __m256 y = _mm256_fmadd_ps(_mm256_cvtepi32_ps(_mm256_srli_epi32(h, 16)), step, cells.y);
    const auto share = [&](float by_x, float by_y) {
        return _mm256_fmadd_ps(x, _mm256_set1_ps(by_x), _mm256_mul_ps(y, _mm256_set1_ps(by_y)));
    };
    const __m256 s = share(p.s_x, p.s_y);
    const __m256 t = share(p.t_x, p.t_y);
    const __m256 most = _mm256_set1_ps(1.0F);
    const __m256 least = _mm256_set1_ps(-1.0F);
    const __m256 inside = _mm256_and_ps(
        _mm256_and_ps(_mm256_cmp_ps(s, least, _CMP_GE_OQ), _mm256_cmp_ps(s, most, _CMP_LT_OQ)),
        _mm256_and_ps(_mm256_cmp_ps(t, least, _CMP_GE_OQ), _mm256_cmp_ps(t, most, _CMP_LT_OQ)));
    const unsigned found = cells.asked & static_cast<unsigned>(_mm256_movemask_ps(inside));
    if (found == 0) return;
    if (block_.pieces.count > PieceBlock::most - search_lanes) {
        fill(p);
        flush();
    }
    const int at = block_.pieces.count;
    const __m256i order = order_of(found);
    const auto store = [&](float* to, __m256 values) {
        _mm256_storeu_ps(to + at, _mm256_permutevar8x32_ps(values, order));
    };
    const auto store_number = [&](std::int32_t* to, __m256i values) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + at),
                            _mm256_permutevar8x32_epi32(values, order));
    };
    store(s_.data(), s);
    store(t_.data(), t);
    store_number(block_.cell[p.first].data(), cells.i);
    store_number(block_.cell[p.second].data(), cells.j);
    _mm256_storeu_ps(block_.edge_m.data() + at, _mm256_set1_ps(cells.edge_m));
    block_.pieces.count += std::popcount(found);
}

/// Completes the scatterers that were found on a sample. Whole vectors are written: what lies
/// beyond the last scatterer is written again.
void Search::fill(const Footprint& p) {
    PieceBlock& pieces = block_.pieces;
    const Sample& sample = p.sample;
    const Eigen::Vector3f place = sample.position;
    const Eigen::Vector3f u = sample.edge_u;
    const Eigen::Vector3f v = sample.edge_v;
    const float height = sample.height_m;
    const std::uint32_t material = sample.material;
    const float ratio = p.area_by_projected;
    const std::int32_t base = p.base[p.axis];
    const float centre = p.centre[p.axis];
    const float along_u = p.u[p.axis];
    const float along_v = p.v[p.axis];
    auto& cell = block_.cell[p.axis];
    for (int first = filled_; first < pieces.count; first += search_lanes) {
        for (int k = first; k < first + search_lanes; ++k) {
            const float s = s_[k];
            const float t = t_[k];
            const float edge = block_.edge_m[k];
            pieces.x[k] = std::fma(s, u.x(), std::fma(t, v.x(), place.x()));
            pieces.y[k] = std::fma(s, u.y(), std::fma(t, v.y(), place.y()));
            pieces.z[k] = std::fma(s, u.z(), std::fma(t, v.z(), place.z()));
            pieces.area_m2[k] = edge * edge * ratio;
            pieces.height_m[k] = height;
            pieces.material[k] = material;
            // Four cells high, the scatterer near the middle: samples of a curved surface are flat
            // and put it a little higher or lower each time, which must not make it another one.
            const float along = std::fma(s, along_u, std::fma(t, along_v, centre));
            const bool smaller = edge == p.fine_m;
            const float fours = std::floor((smaller ? 0.25F : 0.125F) * along);
            cell[k] = (smaller ? base : base / 2) + 4 * static_cast<std::int32_t>(fours) + 1;
        }
    }
    filled_ = pieces.count;
}

}  // namespace

void find_scatterers(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use) {
    Search search(block, use);
    for (const Sample& sample : samples) {
        const Footprint footprint = footprint_of(sample, cells, sonar);
        if (std::isfinite(footprint.s_x + footprint.s_y + footprint.t_x + footprint.t_y))
            search.add(footprint);
    }
    search.flush();
}

}  // namespace sonarsim
