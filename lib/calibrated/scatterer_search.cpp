#include "calibrated/scatterer_search.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "calibrated/cell_lists.h"

namespace sonarsim {

namespace {

/// Where in a cell its point is along the first and the second axis, in edges, by random bits.
__m256 within_first(__m256i bits) {
    return _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_and_si256(bits, all_lanes(0xFFFFU))),
                         _mm256_set1_ps(0x1p-16F));
}

__m256 within_second(__m256i bits) {
    return _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_srli_epi32(bits, 16)), _mm256_set1_ps(0x1p-16F));
}

/// Finds the cells whose points lie on samples and makes scatterers of them. A batch of samples
/// goes through each step together: how often a loop has to run is known well before it begins, and
/// the processor does not wait for it.
class Search {
  public:
    Search(PhiloxKey key, Scatterers& block, const std::function<void(const Scatterers&)>& use)
        : key_(key.k0), block_(block), use_(use) {
        block_.pieces.count = 0;
    }

    void add(std::span<const Sample> samples, const ScattererCells& cells,
             const SonarInScene& sonar);
    void flush() {
        if (block_.pieces.count > 0) use_(block_);
        block_.pieces.count = 0;
        filled_ = 0;
    }

  private:
    /// The scatterers of a sample in the block, up to one before `end`.
    struct Run {
        int sample, end;
    };

    void look_at_whole(int k);
    void look_at_split(int k);
    int room(int k);
    template <int size>
    int keep(int k, __m256i column, __m256i row, __m256i bits, unsigned asked, int to);
    void fill();
    void fill(const Run& run);

    std::uint32_t key_;
    Scatterers& block_;
    const std::function<void(const Scatterers&)>& use_;
    std::span<const Sample> samples_;
    CellFootprints footprints_;
    CellList whole_, split_;  ///< larger cells
    // Of the scatterers of the block: where they lie on their sample, in half edges; the size and
    // the numbers of their cells, from the base of the sample's footprint; and where in these they
    // are, as bits.
    PatchBlock::Array<float> s_{}, t_{}, size_{};
    PatchBlock::Array<std::int32_t> column_{}, row_{}, within_{};
    std::array<Run, CellFootprints::most> runs_{};  ///< that are to be filled
    int runs_count_ = 0;
    int filled_ = 0;  ///< so many scatterers of the block are complete
};

void Search::add(std::span<const Sample> samples, const ScattererCells& cells,
                 const SonarInScene& sonar) {
    samples_ = samples;
    find_footprints(samples, cells, sonar, footprints_);
    list_cells(footprints_, key_, whole_, split_);
    for (int k = 0; k < footprints_.count; ++k) {
        look_at_whole(k);
        look_at_split(k);
        runs_[runs_count_++] = {k, block_.pieces.count};
    }
    fill();
}

/// Makes sure that the block has room for scatterers of sample k, and tells for how many.
int Search::room(int k) {
    if (block_.pieces.count > PatchBlock::most - search_lanes) {
        runs_[runs_count_++] = {k, block_.pieces.count};
        fill();
        flush();
    }
    return PatchBlock::most - block_.pieces.count;
}

void Search::look_at_whole(int k) {
    const int end = whole_.begin[k + 1];
    for (int at = whole_.begin[k]; at < end;) {
        const int stop = std::min(end, at + room(k));
        int count = block_.pieces.count;
        for (; at < stop; at += search_lanes) {
            const auto load = [&](const auto& from) { return load_numbers(from.data() + at); };
            count += keep<2>(k, load(whole_.column), load(whole_.row), load(whole_.bits),
                             0xFFU >> std::max(0, at + search_lanes - stop), count);
        }
        at = stop;
        block_.pieces.count = count;
    }
}

/// Two cells at a time, four parts each.
void Search::look_at_split(int k) {
    const CellFootprints& p = footprints_;
    const __m256i base_i = _mm256_set1_epi32(p.base_first[k]);
    const __m256i base_j = _mm256_set1_epi32(p.base_second[k]);
    const __m256i two_cells = _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1);
    const __m256i right = _mm256_setr_epi32(0, 1, 0, 1, 0, 1, 0, 1);
    const __m256i up = _mm256_setr_epi32(0, 0, 1, 1, 0, 0, 1, 1);
    const int end = split_.begin[k + 1];
    for (int at = split_.begin[k]; at < end;) {
        const int stop = std::min(end, at + room(k) / 4);
        int count = block_.pieces.count;
        for (; at < stop; at += 2) {
            const auto twice = [&](const std::vector<std::int32_t>& from) {
                const auto* const two = reinterpret_cast<const __m128i*>(from.data() + at);
                const __m256i cells = _mm256_permutevar8x32_epi32(
                    _mm256_castsi128_si256(_mm_loadl_epi64(two)), two_cells);
                return _mm256_add_epi32(cells, cells);
            };
            const __m256i column = _mm256_add_epi32(twice(split_.column), right);
            const __m256i row = _mm256_add_epi32(twice(split_.row), up);
            const __m256i bits =
                cell_bits(_mm256_add_epi32(base_i, column), _mm256_add_epi32(base_j, row),
                          p.level[k], p.axis[k], key_);
            count += keep<1>(k, column, row, bits, at + 1 < stop ? 0xFFU : 0x0FU, count);
        }
        at = stop;
        block_.pieces.count = count;
    }
}

/// Keeps those of 8 cells whose points lie on the sample, from place `to` of the block on, and
/// tells how many. Cells are `size` smaller cells large and numbered from the base.
template <int size>
int Search::keep(int k, __m256i column, __m256i row, __m256i bits, unsigned asked, int to) {
    const CellFootprints& p = footprints_;
    const auto off_centre = [](__m256i number, __m256 within, float centre) {
        const __m256 share = _mm256_add_ps(_mm256_cvtepi32_ps(number), within);
        return _mm256_fmsub_ps(_mm256_set1_ps(size), share, _mm256_set1_ps(centre));
    };
    const __m256 x = off_centre(column, within_first(bits), p.first[k]);
    const __m256 y = off_centre(row, within_second(bits), p.second[k]);
    const auto share = [&](float by_x, float by_y) {
        return _mm256_fmadd_ps(x, _mm256_set1_ps(by_x), _mm256_mul_ps(y, _mm256_set1_ps(by_y)));
    };
    const __m256 s = share(p.s_x[k], p.s_y[k]);
    const __m256 t = share(p.t_x[k], p.t_y[k]);
    const __m256 most = _mm256_set1_ps(1.0F);
    const __m256 least = _mm256_set1_ps(-1.0F);
    const __m256 inside = _mm256_and_ps(
        _mm256_and_ps(_mm256_cmp_ps(s, least, _CMP_GE_OQ), _mm256_cmp_ps(s, most, _CMP_LT_OQ)),
        _mm256_and_ps(_mm256_cmp_ps(t, least, _CMP_GE_OQ), _mm256_cmp_ps(t, most, _CMP_LT_OQ)));
    const ToFront front(asked & static_cast<unsigned>(_mm256_movemask_ps(inside)));
    _mm256_storeu_ps(s_.data() + to, front(s));
    _mm256_storeu_ps(t_.data() + to, front(t));
    store_numbers(column_.data() + to, front(column));
    store_numbers(row_.data() + to, front(row));
    store_numbers(within_.data() + to, front(bits));
    _mm256_storeu_ps(size_.data() + to, _mm256_set1_ps(size));
    return front.count;
}

void Search::fill() {
    for (int r = 0; r < runs_count_; ++r)
        fill(runs_[r]);
    runs_count_ = 0;
}

/// Completes the scatterers that were found on a sample. Whole vectors are written: what lies
/// beyond the last scatterer is written again.
void Search::fill(const Run& run) {
    PatchBlock& pieces = block_.pieces;
    const CellFootprints& p = footprints_;
    const Sample& sample = samples_[run.sample];
    const Eigen::Vector3f& position = sample.position;
    const Eigen::Vector3f& u = sample.edge_u;
    const Eigen::Vector3f& v = sample.edge_v;
    const int of = run.sample;
    const auto one = [](float value) { return _mm256_set1_ps(value); };
    for (int k = filled_; k < run.end; k += search_lanes) {
        const __m256 s = _mm256_loadu_ps(s_.data() + k);
        const __m256 t = _mm256_loadu_ps(t_.data() + k);
        const auto place = [&](float centre, float by_s, float by_t) {
            return _mm256_fmadd_ps(s, one(by_s), _mm256_fmadd_ps(t, one(by_t), one(centre)));
        };
        const auto write = [&](float* to, __m256 values) { _mm256_storeu_ps(to + k, values); };
        write(pieces.x.data(), place(position.x(), u.x(), v.x()));
        write(pieces.y.data(), place(position.y(), u.y(), v.y()));
        write(pieces.z.data(), place(position.z(), u.z(), v.z()));
        write(pieces.height_m.data(), one(sample.height_m));
        store_numbers(reinterpret_cast<std::int32_t*>(pieces.material.data()) + k,
                      all_lanes(sample.material));
        const __m256 size = _mm256_loadu_ps(size_.data() + k);
        const __m256 edge = _mm256_mul_ps(size, one(p.fine_m[of]));
        write(block_.edge_m.data(), edge);
        write(pieces.area_m2.data(),
              _mm256_mul_ps(_mm256_mul_ps(edge, edge), one(p.area_by_projected[of])));
        // Numbers from the base become those of the lattice: it is a multiple of 8.
        const __m256i larger = _mm256_srli_epi32(_mm256_cvttps_epi32(size), 1);
        const auto name = [&](int axis, std::int32_t base, __m256i number) {
            const __m256i in_lattice = _mm256_srav_epi32(_mm256_set1_epi32(base), larger);
            store_numbers(block_.cell[axis].data() + k, _mm256_add_epi32(in_lattice, number));
        };
        const int axis = p.axis[of];
        name((axis + 1) % 3, p.base_first[of], load_numbers(column_.data() + k));
        name((axis + 2) % 3, p.base_second[of], load_numbers(row_.data() + k));
        // Four cells high, the scatterer near the middle: samples of a curved surface are flat
        // and put it a little higher or lower each time, which must not make it another one.
        const __m256 height = place(p.height[of], p.height_u[of], p.height_v[of]);
        const __m256 fours = _mm256_floor_ps(
            _mm256_mul_ps(height, _mm256_sub_ps(one(0.375F), _mm256_mul_ps(size, one(0.125F)))));
        const __m256i bottom = _mm256_slli_epi32(_mm256_cvttps_epi32(fours), 2);
        name(axis, p.base_axis[of], _mm256_add_epi32(bottom, _mm256_set1_epi32(1)));
        // The phase is that of the very place at which the scatterer is in its beam: were it one
        // elsewhere in the cell, speckle would decorrelate faster than the aperture has it.
        const __m256i within = load_numbers(within_.data() + k);
        write(block_.within[(axis + 1) % 3].data(), within_first(within));
        write(block_.within[(axis + 2) % 3].data(), within_second(within));
        write(block_.within[axis].data(), one(0.5F));
    }
    filled_ = run.end;
}

}  // namespace

void find_scatterers(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, PhiloxKey key, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use) {
    constexpr std::size_t batch = CellFootprints::most;
    Search search(key, block, use);
    for (std::size_t first = 0; first < samples.size(); first += batch)
        search.add(samples.subspan(first, std::min(batch, samples.size() - first)), cells, sonar);
    search.flush();
}

}  // namespace sonarsim
