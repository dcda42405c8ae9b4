#include "calibrated/scatterer_search.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "calibrated/cell_footprint.h"

namespace sonarsim {

namespace {

constexpr int search_lanes = 8;
constexpr int batch = 32;  // of samples

__m256i all(std::uint32_t word) {
    return _mm256_set1_epi32(static_cast<int>(word));
}

__m256i load_numbers(const std::int32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

void store_numbers(std::int32_t* to, __m256i values) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), values);
}

/// 32 bits that look random by 64 (the finaliser of MurmurHash3, put to the words in turn).
__m256i mixed(__m256i a, __m256i b) {
    const __m256i one = all(0x85EBCA6BU);
    const __m256i other = all(0xC2B2AE35U);
    __m256i h = _mm256_mullo_epi32(a, one);
    h = _mm256_xor_si256(h, _mm256_srli_epi32(h, 15));
    h = _mm256_add_epi32(h, _mm256_mullo_epi32(b, other));
    h = _mm256_mullo_epi32(_mm256_xor_si256(h, _mm256_srli_epi32(h, 16)), one);
    h = _mm256_mullo_epi32(_mm256_xor_si256(h, _mm256_srli_epi32(h, 13)), other);
    return _mm256_xor_si256(h, _mm256_srli_epi32(h, 16));
}

/// Random bits of a level's cells by their numbers.
__m256i cell_bits(__m256i i, __m256i j, std::uint32_t level, int axis) {
    return mixed(_mm256_xor_si256(i, all(level << 27)),
                 _mm256_xor_si256(j, all(static_cast<std::uint32_t>(axis + 1) << 29)));
}

/// Where in its cell a scatterer is seen, 16 bits along each axis: by the bits of the cell that is
/// twice as large, and by which of its four parts it is. Large or small, whole or a part, a cell
/// has its scatterer in the same place.
__m256i place_in_cell(__m256i larger, __m256i part) {
    const __m256i keys =
        _mm256_setr_epi32(0x3C6EF372, 0x1B873593, 0x7F4A7C15, 0x5851F42D, 0, 0, 0, 0);
    __m256i h = _mm256_xor_si256(larger, _mm256_permutevar8x32_epi32(keys, part));
    h = _mm256_mullo_epi32(h, all(0x7FEB352DU));
    h = _mm256_xor_si256(h, _mm256_srli_epi32(h, 15));
    h = _mm256_mullo_epi32(h, all(0x846CA68BU));
    return _mm256_xor_si256(h, _mm256_srli_epi32(h, 16));
}

/// By 8 bits, the numbers of those that are set, in order, and then 0.
constexpr std::array<std::uint64_t, 256> orders() {
    std::array<std::uint64_t, 256> out{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        int place = 0;
        for (unsigned bit = 0; bit < 8; ++bit) {
            if ((mask >> bit & 1U) != 0) out[mask] |= std::uint64_t{bit} << (8 * place++);
        }
    }
    return out;
}
constexpr std::array<std::uint64_t, 256> order_by_mask = orders();

/// Moves the lanes of a mask to the front.
struct ToFront {
    __m256i order;
    int count;

    explicit ToFront(unsigned mask)
        : order(
              _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(order_by_mask[mask])))),
          count(std::popcount(mask)) {}

    __m256i operator()(__m256i values) const { return _mm256_permutevar8x32_epi32(values, order); }
    __m256 operator()(__m256 values) const { return _mm256_permutevar8x32_ps(values, order); }
};

/// Cells of the samples of a batch: their numbers from the base of their sample's footprint, along
/// its two axes.
struct CellList {
    std::vector<std::int32_t> column, row;
    std::vector<std::int32_t> bits;  ///< random, by the cell
    int count = 0;
    std::array<int, batch + 1> begin{};  ///< by sample

    CellList() { grow(); }
    /// Makes room for a vector of further cells.
    void make_room() {
        if (static_cast<std::size_t>(count + search_lanes) > bits.size()) grow();
    }
    void grow() {
        const std::size_t size = std::max<std::size_t>(2 * bits.size(), 1024);
        column.resize(size);
        row.resize(size);
        bits.resize(size);
    }
    void add(const ToFront& front, __m256i columns, __m256i rows, __m256i random) {
        store_numbers(column.data() + count, front(columns));
        store_numbers(row.data() + count, front(rows));
        store_numbers(bits.data() + count, front(random));
        count += front.count;
    }
};

/// Finds the cells whose points lie on samples and makes scatterers of them, a batch of samples at
/// a time: what a step decides is known long before the next one branches by it.
class Search {
  public:
    Search(Scatterers& block, const std::function<void(const Scatterers&)>& use)
        : block_(block), use_(use) {
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

    void list_cells(const CellFootprint& p);
    void look_at_whole(int k);
    void look_at_split(int k);
    void keep(const CellFootprint& p, __m256i column, __m256i row, __m256i place, float size,
              unsigned asked);
    void fill();
    void fill(const Sample& sample, const CellFootprint& p, int end);

    Scatterers& block_;
    const std::function<void(const Scatterers&)>& use_;
    std::span<const Sample> samples_;
    std::array<CellFootprint, batch> footprints_;
    CellList whole_, split_;  ///< larger cells
    // Of the scatterers of the block: where they lie on their sample, in half edges; and the size
    // and the numbers of their cells, from the base of the sample's footprint.
    PieceBlock::Array<float> s_{}, t_{}, size_{};
    PieceBlock::Array<std::int32_t> column_{}, row_{};
    std::array<Run, batch> runs_{};  ///< that are to be filled
    int runs_count_ = 0;
    int filled_ = 0;  ///< so many scatterers of the block are complete
};

void Search::add(std::span<const Sample> samples, const ScattererCells& cells,
                 const SonarInScene& sonar) {
    samples_ = samples;
    const auto count = static_cast<int>(samples.size());
    whole_.count = 0;
    split_.count = 0;
    for (int k = 0; k < count; ++k) {
        footprints_[k] = footprint_of(samples[k], cells, sonar);
        whole_.begin[k] = whole_.count;
        split_.begin[k] = split_.count;
        if (footprints_[k].has_area()) list_cells(footprints_[k]);
    }
    whole_.begin[count] = whole_.count;
    split_.begin[count] = split_.count;
    for (int k = 0; k < count; ++k) {
        look_at_whole(k);
        look_at_split(k);
        runs_[runs_count_++] = {k, block_.pieces.count};
    }
    fill();
}

/// Larger cells are split or not, and hold a scatterer each or four.
void Search::list_cells(const CellFootprint& p) {
    const CellRows rows(p);
    const bool along_first = rows.inner == p.first;
    const __m256i steps = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i base_i = _mm256_set1_epi32(p.base[p.first] / 2);
    const __m256i base_j = _mm256_set1_epi32(p.base[p.second] / 2);
    const __m256i first_split = _mm256_set1_epi32(static_cast<int>(p.whole_cells * 0x1p24F));
    for (std::int32_t outer = rows.first; outer <= rows.last; ++outer) {
        const CellRows::Row along = rows.row(outer);
        for (std::int32_t inner = along.first; inner <= along.last; inner += search_lanes) {
            const __m256i in = _mm256_add_epi32(_mm256_set1_epi32(inner), steps);
            const __m256i out = _mm256_set1_epi32(outer);
            const __m256i column = along_first ? in : out;
            const __m256i row = along_first ? out : in;
            const __m256i bits = cell_bits(_mm256_add_epi32(base_i, column),
                                           _mm256_add_epi32(base_j, row), p.level + 1, p.axis);
            const auto is_whole = static_cast<unsigned>(_mm256_movemask_ps(
                _mm256_castsi256_ps(_mm256_cmpgt_epi32(first_split, _mm256_srli_epi32(bits, 8)))));
            const unsigned meant = 0xFFU >> std::max(0, inner + search_lanes - 1 - along.last);
            whole_.make_room();
            whole_.add(ToFront(meant & is_whole), column, row, bits);
            split_.make_room();
            split_.add(ToFront(meant & ~is_whole), column, row, bits);
        }
    }
}

void Search::look_at_whole(int k) {
    const CellFootprint& p = footprints_[k];
    const __m256i base_i = _mm256_set1_epi32(p.base[p.first] / 2);
    const __m256i base_j = _mm256_set1_epi32(p.base[p.second] / 2);
    const __m256i one = _mm256_set1_epi32(1);
    const int end = whole_.begin[k + 1];
    for (int at = whole_.begin[k]; at < end; at += search_lanes) {
        const __m256i column = load_numbers(whole_.column.data() + at);
        const __m256i row = load_numbers(whole_.row.data() + at);
        const __m256i i = _mm256_add_epi32(base_i, column);
        const __m256i j = _mm256_add_epi32(base_j, row);
        const __m256i larger =
            cell_bits(_mm256_srai_epi32(i, 1), _mm256_srai_epi32(j, 1), p.level + 2, p.axis);
        const __m256i part = _mm256_add_epi32(_mm256_and_si256(i, one),
                                              _mm256_slli_epi32(_mm256_and_si256(j, one), 1));
        keep(p, column, row, place_in_cell(larger, part), 2.0F,
             0xFFU >> std::max(0, at + search_lanes - end));
    }
}

/// Two cells at a time, four parts each.
void Search::look_at_split(int k) {
    const CellFootprint& p = footprints_[k];
    const __m256i two_cells = _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1);
    const __m256i part = _mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3);
    const __m256i right = _mm256_setr_epi32(0, 1, 0, 1, 0, 1, 0, 1);
    const __m256i up = _mm256_setr_epi32(0, 0, 1, 1, 0, 0, 1, 1);
    const int end = split_.begin[k + 1];
    for (int at = split_.begin[k]; at < end; at += 2) {
        const auto load = [&](const std::vector<std::int32_t>& from) {
            const auto* const two = reinterpret_cast<const __m128i*>(from.data() + at);
            return _mm256_permutevar8x32_epi32(_mm256_castsi128_si256(_mm_loadl_epi64(two)),
                                               two_cells);
        };
        const __m256i column = load(split_.column);
        const __m256i row = load(split_.row);
        keep(p, _mm256_add_epi32(_mm256_add_epi32(column, column), right),
             _mm256_add_epi32(_mm256_add_epi32(row, row), up),
             place_in_cell(load(split_.bits), part), 1.0F, at + 1 < end ? 0xFFU : 0x0FU);
    }
}

/// Keeps those of 8 cells whose points lie on the sample. Cells are `size` smaller cells large and
/// numbered from the base.
void Search::keep(const CellFootprint& p, __m256i column, __m256i row, __m256i place, float size,
                  unsigned asked) {
    const auto off_centre = [&](__m256i number, __m256i bits, int along) {
        const __m256 share = _mm256_fmadd_ps(_mm256_cvtepi32_ps(bits), _mm256_set1_ps(0x1p-16F),
                                             _mm256_cvtepi32_ps(number));
        return _mm256_fmsub_ps(_mm256_set1_ps(size), share, _mm256_set1_ps(p.centre[along]));
    };
    const __m256 x = off_centre(column, _mm256_and_si256(place, all(0xFFFFU)), p.first);
    const __m256 y = off_centre(row, _mm256_srli_epi32(place, 16), p.second);
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
    const ToFront front(asked & static_cast<unsigned>(_mm256_movemask_ps(inside)));
    if (block_.pieces.count > PieceBlock::most - search_lanes) {
        runs_[runs_count_++] = {static_cast<int>(&p - footprints_.data()), block_.pieces.count};
        fill();
        flush();
    }
    const int at = block_.pieces.count;
    _mm256_storeu_ps(s_.data() + at, front(s));
    _mm256_storeu_ps(t_.data() + at, front(t));
    store_numbers(column_.data() + at, front(column));
    store_numbers(row_.data() + at, front(row));
    _mm256_storeu_ps(size_.data() + at, _mm256_set1_ps(size));
    block_.pieces.count += front.count;
}

void Search::fill() {
    for (int r = 0; r < runs_count_; ++r)
        fill(samples_[runs_[r].sample], footprints_[runs_[r].sample], runs_[r].end);
    runs_count_ = 0;
}

/// Completes the scatterers that were found on a sample. Whole vectors are written: what lies
/// beyond the last scatterer is written again.
void Search::fill(const Sample& sample, const CellFootprint& p, int end) {
    PieceBlock& pieces = block_.pieces;
    const auto one = [](float value) { return _mm256_set1_ps(value); };
    for (int k = filled_; k < end; k += search_lanes) {
        const __m256 s = _mm256_loadu_ps(s_.data() + k);
        const __m256 t = _mm256_loadu_ps(t_.data() + k);
        const auto place = [&](const Eigen::Vector3f& at, const Eigen::Vector3f& u,
                               const Eigen::Vector3f& v, int along) {
            return _mm256_fmadd_ps(s, one(u[along]),
                                   _mm256_fmadd_ps(t, one(v[along]), one(at[along])));
        };
        const auto write = [&](float* to, __m256 values) { _mm256_storeu_ps(to + k, values); };
        write(pieces.x.data(), place(sample.position, sample.edge_u, sample.edge_v, 0));
        write(pieces.y.data(), place(sample.position, sample.edge_u, sample.edge_v, 1));
        write(pieces.z.data(), place(sample.position, sample.edge_u, sample.edge_v, 2));
        write(pieces.height_m.data(), one(sample.height_m));
        store_numbers(reinterpret_cast<std::int32_t*>(pieces.material.data()) + k,
                      all(sample.material));
        const __m256 size = _mm256_loadu_ps(size_.data() + k);
        const __m256 edge = _mm256_mul_ps(size, one(p.fine_m));
        write(block_.edge_m.data(), edge);
        write(pieces.area_m2.data(),
              _mm256_mul_ps(_mm256_mul_ps(edge, edge), one(p.area_by_projected)));
        // Numbers from the base become those of the lattice: it is a multiple of 8.
        const __m256i larger = _mm256_srli_epi32(_mm256_cvttps_epi32(size), 1);
        const auto base = [&](int along) {
            return _mm256_srav_epi32(_mm256_set1_epi32(p.base[along]), larger);
        };
        const auto name = [&](int along, __m256i number) {
            store_numbers(block_.cell[along].data() + k, _mm256_add_epi32(base(along), number));
        };
        name(p.first, load_numbers(column_.data() + k));
        name(p.second, load_numbers(row_.data() + k));
        // Four cells high, the scatterer near the middle: samples of a curved surface are flat
        // and put it a little higher or lower each time, which must not make it another one.
        const __m256 height = place(p.centre, p.u, p.v, p.axis);
        const __m256 fours = _mm256_floor_ps(
            _mm256_mul_ps(height, _mm256_sub_ps(one(0.375F), _mm256_mul_ps(size, one(0.125F)))));
        const __m256i bottom = _mm256_slli_epi32(_mm256_cvttps_epi32(fours), 2);
        name(p.axis, _mm256_add_epi32(bottom, _mm256_set1_epi32(1)));
    }
    filled_ = end;
}

}  // namespace

void find_scatterers(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use) {
    Search search(block, use);
    for (std::size_t first = 0; first < samples.size(); first += batch)
        search.add(samples.subspan(first, std::min<std::size_t>(batch, samples.size() - first)),
                   cells, sonar);
    search.flush();
}

}  // namespace sonarsim
