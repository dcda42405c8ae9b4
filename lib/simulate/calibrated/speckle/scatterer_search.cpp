#include <algorithm>
#include <vector>

#include "core/lanes.h"
#include "simulate/calibrated/speckle/cell_footprints.h"

// The drawing in docs/calibrated.md, section 2, shows the steps: the rows of larger cells under a
// footprint, those that are split, and the points that lie on it.

namespace sonarsim {

namespace {

/// A one-to-one function of 32 bits whose results look random.
Ints8 hash8(Ints8 h) {
    h = (h ^ (h >> 16)) * Ints8(0x7FEB352DU);
    h = (h ^ (h >> 15)) * Ints8(0x846CA68BU);
    return h ^ (h >> 16);
}

/// Random bits of the larger cells above a level, seen along an axis, by their numbers and a key.
Ints8 cell_bits(Ints8 i, Ints8 j, std::int32_t level, std::int32_t axis, std::uint32_t key) {
    const auto plane = static_cast<std::uint32_t>(4 * level + axis + 1) * 0x9E3779B1U;
    const Ints8 cell = i * Ints8(0x85EBCA6BU) + j * Ints8(0xC2B2AE35U) + Ints8(plane);
    return hash8(cell ^ Ints8(key));
}

/// The place of the points of a column's cells along the row, or of a row's along the column, in
/// edges: `line` is the number of that column or row, `along` 0 for columns and 1 for rows. Points
/// that share it are evenly spaced, so that sums over them hardly vary (docs/calibrated.md,
/// section 2), and yet the place of each is uniform in its cell.
Floats8 place_on_line(Ints8 line, std::int32_t level, std::int32_t axis, int along,
                      std::uint32_t key) {
    const auto plane = static_cast<std::uint32_t>(8 * level + 2 * axis + along + 1) * 0x9E3779B1U;
    const Ints8 bits = hash8((line * Ints8(0x85EBCA6BU) + Ints8(plane)) ^ Ints8(key));
    return to_floats(bits & Ints8(0xFFFFU)) * 0x1p-16F;
}

/// Cells under the samples of a batch, by column and row from the base of the sample's footprint.
struct CellList {
    std::vector<std::int32_t> column, row;
    int count = 0;
    std::array<int, CellFootprints::capacity + 1> begin{};  ///< the first cell of each sample

    CellList() { grow(); }
    void grow() {
        const std::size_t size = std::max<std::size_t>(2 * column.size(), 1024);
        column.resize(size);
        row.resize(size);
    }
    void add(unsigned mask, Ints8 columns, Ints8 rows) {
        // Eight lanes are written, and may be read from any cell on.
        if (count + 2 * lanes > std::ssize(column)) grow();
        const ToFront front(mask);
        front(columns).store(column.data() + count);
        front(rows).store(row.data() + count);
        count += front.count;
    }
};

/// Adds the larger cells under a footprint, eight rows at a time: to `whole` those that hold one
/// scatterer, to `split` those that are split into four.
void list_cells(const CellFootprints& p, int k, std::uint32_t key, CellList& whole,
                CellList& split) {
    const Ints8 base_i = p.base_first[k] / 2;
    const Ints8 base_j = p.base_second[k] / 2;
    const Ints8 first_split = static_cast<std::int32_t>(p.unsplit_share[k] * 0x1p24F);
    const bool along_first = p.rows_along_first[k] != 0;
    for (std::int32_t n = p.row_begin[k]; n < p.row_end[k]; n += lanes) {
        const Ints8 outer = Ints8(n) + lane_numbers();
        const Floats8 left = fma(p.slope[k], to_floats(outer), p.left[k]);
        const Floats8 right = left + p.width[k];
        Ints8 inner = to_ints(max(floor(left), p.min_inner[k]));
        const Ints8 end = to_ints(min(floor(right), p.max_inner[k])) + 1;
        const unsigned is_row = (Ints8(p.row_end[k]) > outer).bits();
        while (const unsigned in_row = is_row & (end > inner).bits()) {
            const Ints8 column = along_first ? outer : inner;
            const Ints8 row = along_first ? inner : outer;
            const Ints8 bits = cell_bits(base_i + column, base_j + row, p.level[k], p.axis[k], key);
            const unsigned is_whole = (first_split > (bits >> 8)).bits();
            whole.add(in_row & is_whole, column, row);
            split.add(in_row & ~is_whole, column, row);
            inner = inner + 1;
        }
    }
}

/// Finds the cells whose points lie on samples and makes scatterers of them. A batch of samples
/// passes each step together: the processor knows the length of loops early.
class Search {
  public:
    Search(PhiloxKey key, Scatterers& block, const std::function<void(const Scatterers&)>& use)
        : key_(key.k0), block_(block), use_(use) {
        block_.pieces.count = 0;
    }

    /// `first`: the number of the first of these samples.
    void add(std::span<const Sample> samples, std::size_t first, ViewShape shape,
             const ScattererCells& cells, const SonarInScene& sonar) {
        samples_ = samples;
        number_of_first_ = first;
        find_footprints(samples, shape, cells, sonar, footprints_);
        whole_.count = split_.count = 0;
        for (int k = 0; k < footprints_.count; ++k) {
            whole_.begin[k] = whole_.count;
            split_.begin[k] = split_.count;
            list_cells(footprints_, k, key_, whole_, split_);
        }
        whole_.begin[footprints_.count] = whole_.count;
        split_.begin[footprints_.count] = split_.count;
        for (int k = 0; k < footprints_.count; ++k) {
            emit_coarse(k);
            emit_fine(k);
            runs_[run_count_++] = {k, block_.pieces.count};
        }
        complete_runs();
    }

    void flush() {
        if (block_.pieces.count > 0) use_(block_);
        block_.pieces.count = 0;
        completed_ = 0;
    }

  private:
    /// The scatterers of a sample in the block, from the end of the previous run to `end` - 1.
    struct Run {
        int sample, end;
    };

    /// Makes room in the block for scatterers of sample k, and returns their greatest number.
    int room(int k) {
        if (block_.pieces.count > PatchBlock::capacity - lanes) {
            runs_[run_count_++] = {k, block_.pieces.count};
            complete_runs();
            flush();
        }
        return PatchBlock::capacity - block_.pieces.count;
    }

    void complete_runs() {
        for (int r = 0; r < run_count_; ++r)
            complete(runs_[r]);
        run_count_ = 0;
    }

    void emit_coarse(int k) {
        const int end = whole_.begin[k + 1];
        for (int at = whole_.begin[k]; at < end;) {
            const int stop = std::min(end, at + room(k));
            int count = block_.pieces.count;
            for (; at < stop; at += lanes) {
                count += keep<2>(k, Ints8::load(whole_.column.data() + at),
                                 Ints8::load(whole_.row.data() + at),
                                 0xFFU >> std::max(0, at + lanes - stop), count);
            }
            at = stop;
            block_.pieces.count = count;
        }
    }

    /// Two cells at a time, four parts each.
    void emit_fine(int k) {
        const Ints8 right = _mm256_setr_epi32(0, 1, 0, 1, 0, 1, 0, 1);
        const Ints8 up = _mm256_setr_epi32(0, 0, 1, 1, 0, 0, 1, 1);
        const int end = split_.begin[k + 1];
        for (int at = split_.begin[k]; at < end;) {
            const int stop = std::min(end, at + room(k) / 4);
            int count = block_.pieces.count;
            for (; at < stop; at += 2) {
                const Ints8 columns = two_by_four(split_.column.data() + at);
                const Ints8 rows = two_by_four(split_.row.data() + at);
                const Ints8 column = columns + columns + right;
                const Ints8 row = rows + rows + up;
                count += keep<1>(k, column, row, at + 1 < stop ? 0xFFU : 0x0FU, count);
            }
            at = stop;
            block_.pieces.count = count;
        }
    }

    /// Keeps the cells, of 8, whose points lie on the sample: writes them from place `to` of the
    /// block on and returns their number. A cell has `size` edges of a smaller cell.
    template <int size>
    int keep(int k, Ints8 column, Ints8 row, unsigned mask, int to) {
        const CellFootprints& p = footprints_;
        constexpr auto edges = static_cast<float>(size);
        const std::int32_t level = p.level[k] + size - 1;
        const Floats8 along_first =
            place_on_line(Ints8(p.base_second[k] / size) + row, level, p.axis[k], 0, key_);
        const Floats8 along_second =
            place_on_line(Ints8(p.base_first[k] / size) + column, level, p.axis[k], 1, key_);
        const Floats8 x = fms(edges, to_floats(column) + along_first, p.first[k]);
        const Floats8 y = fms(edges, to_floats(row) + along_second, p.second[k]);
        const Floats8 s = fma(x, p.s_x[k], y * p.s_y[k]);
        const Floats8 t = fma(x, p.t_x[k], y * p.t_y[k]);
        const Floats8 half_u = fma(t, p.taper_v[k], 1.0F);
        const Floats8 half_v = fma(s, p.taper_u[k], 1.0F);
        const Mask8 inside =
            (s >= 0.0F - half_u) & (s < half_u) & ((t >= 0.0F - half_v) & (t < half_v));
        const ToFront front(mask & inside.bits());
        front(s).store(s_.data() + to);
        front(t).store(t_.data() + to);
        front(column).store(column_.data() + to);
        front(row).store(row_.data() + to);
        front(along_first).store(along_first_.data() + to);
        front(along_second).store(along_second_.data() + to);
        Floats8(edges).store(size_.data() + to);
        return front.count;
    }

    /// Completes the scatterers of a sample, eight at a time; later ones overwrite spare lanes.
    void complete(const Run& run) {
        PatchBlock& pieces = block_.pieces;
        const CellFootprints& p = footprints_;
        const int of = run.sample;
        const Sample& sample = samples_[of];
        const Eigen::Vector3f& u = sample.edge_u;
        const Eigen::Vector3f middle = sample.middle();
        const Eigen::Vector3f& v = sample.edge_v;
        const int axis = p.axis[of];
        const int first = (axis + 1) % 3;
        const int second = (axis + 2) % 3;
        for (int k = completed_; k < run.end; k += lanes) {
            const Floats8 s = Floats8::load(s_.data() + k);
            const Floats8 t = Floats8::load(t_.data() + k);
            const auto along = [&](float centre, float by_s, float by_t) {
                return fma(s, by_s, fma(t, by_t, centre));
            };
            along(middle.x(), u.x(), v.x()).store(pieces.x.data() + k);
            along(middle.y(), u.y(), v.y()).store(pieces.y.data() + k);
            along(middle.z(), u.z(), v.z()).store(pieces.z.data() + k);
            Floats8(sample.height_m).store(pieces.height_m.data() + k);
            Ints8(sample.material)
                .store(reinterpret_cast<std::int32_t*>(pieces.material.data()) + k);
            Ints8(static_cast<std::uint32_t>(number_of_first_ + of))
                .store(reinterpret_cast<std::int32_t*>(pieces.sample.data()) + k);
            const Floats8 size = Floats8::load(size_.data() + k);
            const Floats8 edge = size * p.fine_m[of];
            edge.store(block_.edge_m.data() + k);
            (edge * edge * p.area_by_projected[of]).store(pieces.area_m2.data() + k);
            // Numbers from the base become numbers of the lattice; the base is a multiple of 8.
            const Ints8 is_larger = to_ints(size) >> 1;
            const auto number = [&](int side, std::int32_t base, Ints8 from_base) {
                (halved(base, is_larger) + from_base).store(block_.cell[side].data() + k);
            };
            number(first, p.base_first[of], Ints8::load(column_.data() + k));
            number(second, p.base_second[of], Ints8::load(row_.data() + k));
            // Cells are four edges high, with the scatterer near the middle: cuts of a curved
            // surface into flat samples differ a little in height, which must not change it. No
            // cell has its border at 0, where floors are.
            constexpr float below = 0.382F;
            const Floats8 height = along(p.height[of], p.height_u[of], p.height_v[of]);
            const Floats8 fours = floor(fma(height, Floats8(0.375F) - size * 0.125F, below));
            number(axis, p.base_axis[of], to_ints(fours) << 2);
            // The phase follows from the scatterer's own place. With the phase of another place in
            // the cell, speckle would decorrelate faster than the aperture allows.
            Floats8::load(along_first_.data() + k).store(block_.within[first].data() + k);
            Floats8::load(along_second_.data() + k).store(block_.within[second].data() + k);
            Floats8(0.5F).store(block_.within[axis].data() + k);
        }
        completed_ = run.end;
    }

    std::uint32_t key_;
    Scatterers& block_;
    const std::function<void(const Scatterers&)>& use_;
    std::span<const Sample> samples_;
    std::size_t number_of_first_ = 0;
    CellFootprints footprints_;
    CellList whole_, split_;  ///< larger cells
    // For each scatterer of the block: its position on the sample, in half edges; its cell's size
    // and numbers, from the base of the sample's footprint; and its place in the cell, in edges.
    PatchBlock::Array<float> s_{}, t_{}, size_{}, along_first_{}, along_second_{};
    PatchBlock::Array<std::int32_t> column_{}, row_{};
    std::array<Run, CellFootprints::capacity> runs_{};  ///< not completed yet
    int run_count_ = 0;
    int completed_ = 0;  ///< number of complete scatterers in the block
};

}  // namespace

void find_scatterers(std::span<const Sample> samples, ViewShape shape, const ScattererCells& cells,
                     const SonarInScene& sonar, PhiloxKey key, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use) {
    constexpr std::size_t batch = CellFootprints::capacity;
    Search search(key, block, use);
    for (std::size_t first = 0; first < samples.size(); first += batch)
        search.add(samples.subspan(first, std::min(batch, samples.size() - first)), first, shape,
                   cells, sonar);
    search.flush();
}

}  // namespace sonarsim
