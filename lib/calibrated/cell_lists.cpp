#include "calibrated/cell_lists.h"

namespace sonarsim {

namespace {

/// Those of one sample, eight rows at a time.
void list_cells_of(const CellFootprints& p, int k, std::uint32_t key, CellList& whole,
                   CellList& split) {
    const auto one = [](float value) { return _mm256_set1_ps(value); };
    const __m256i base_i = _mm256_set1_epi32(p.base_first[k] / 2);
    const __m256i base_j = _mm256_set1_epi32(p.base_second[k] / 2);
    const __m256i first_split = _mm256_set1_epi32(static_cast<int>(p.whole[k] * 0x1p24F));
    const __m256i end = _mm256_set1_epi32(p.row_end[k]);
    const bool along_first = p.rows_along_first[k] != 0;
    for (std::int32_t n = p.row_begin[k]; n < p.row_end[k]; n += search_lanes) {
        const __m256i number =
            _mm256_add_epi32(_mm256_set1_epi32(n), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
        const __m256 left =
            _mm256_fmadd_ps(one(p.slope[k]), _mm256_cvtepi32_ps(number), one(p.left[k]));
        const __m256 right = _mm256_add_ps(left, one(p.width[k]));
        __m256i inner = _mm256_cvttps_epi32(_mm256_max_ps(_mm256_floor_ps(left), one(p.least[k])));
        const __m256i beyond = _mm256_add_epi32(
            _mm256_cvttps_epi32(_mm256_min_ps(_mm256_floor_ps(right), one(p.greatest[k]))),
            _mm256_set1_epi32(1));
        const __m256i is_row = _mm256_cmpgt_epi32(end, number);
        while (true) {
            const unsigned meant =
                mask_of(_mm256_and_si256(is_row, _mm256_cmpgt_epi32(beyond, inner)));
            if (meant == 0) break;
            const __m256i column = along_first ? number : inner;
            const __m256i row = along_first ? inner : number;
            const __m256i bits =
                cell_bits(_mm256_add_epi32(base_i, column), _mm256_add_epi32(base_j, row),
                          p.level[k] + 1, p.axis[k], key);
            // Not the bits themselves: they say where in the cell its point is.
            const __m256i other_bits = _mm256_mullo_epi32(bits, all_lanes(0x9E3779B1U));
            const unsigned is_whole =
                mask_of(_mm256_cmpgt_epi32(first_split, _mm256_srli_epi32(other_bits, 8)));
            whole.add(ToFront(meant & is_whole), column, row, bits);
            split.add(ToFront(meant & ~is_whole), column, row, bits);
            inner = _mm256_add_epi32(inner, _mm256_set1_epi32(1));
        }
    }
}

}  // namespace

void list_cells(const CellFootprints& footprints, std::uint32_t key, CellList& whole,
                CellList& split) {
    whole.count = 0;
    split.count = 0;
    for (int k = 0; k < footprints.count; ++k) {
        whole.begin[k] = whole.count;
        split.begin[k] = split.count;
        list_cells_of(footprints, k, key, whole, split);
    }
    whole.begin[footprints.count] = whole.count;
    split.begin[footprints.count] = split.count;
}

}  // namespace sonarsim
