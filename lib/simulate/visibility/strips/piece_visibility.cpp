#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "simulate/visibility/strips/strip_samples.h"

namespace sonarsim {

namespace {

// Directions w as near as this, times 1 + |w|, are one.
constexpr float same_w = 1e-6F;

// The same for a piece that is seen nearly edge-on, as a share of its extent in w.
constexpr float same_share = 0.02F;

// Overlaps of less than this share of the above are ignored: those of neighbours by rounding.
// Several slivers side by side may hide more than the above.
constexpr float overlap_share = 0.125F;

// Depths as near as this share are one; then the facet of the lower number is the nearer one.
constexpr float same_depth = 2e-6F;

}  // namespace

void PieceVisibility::begin(int i) {
    const PieceBlock& p = pieces_.block_of(i);
    const int k = i % lanes;
    piece_ = i;
    candidates_.clear();
    next_group_ = 0;
    blocks_left_ = 0;
    eps_ = std::min(same_w * (1.0F + std::max(std::fabs(p.w_min[k]), std::fabs(p.w_max[k]))),
                    same_share * (p.w_max[k] - p.w_min[k]));
    from_ = p.from[k];
    to_ = p.to[k];
    w_min_ = p.w_min[k] + eps_;
    w_max_ = p.w_max[k] - eps_;
    q_min_ = p.q_min[k] * (1.0F - same_depth);
}

/// The rows whose bounds overlap the piece and which may be nearer.
template <class Rows>
unsigned PieceVisibility::near(const Rows& rows) const {
    const auto load = [](const PieceBlock::Row& row) { return Floats8::load(row.data()); };
    return ((load(rows.from) < to_) & (load(rows.to) > from_) & (load(rows.w_min) < w_max_) &
            (load(rows.w_max) > w_min_) & (load(rows.q_max) > q_min_))
        .bits();
}

/// Adds the next block with pieces that may hide some of the piece; false: there is none.
bool PieceVisibility::find_more() {
    while (true) {
        while (blocks_left_ == 0) {
            if (next_group_ == pieces_.bounds().size()) return false;
            blocks_left_ = near(pieces_.bounds()[next_group_++]);
        }
        const int block =
            lanes * static_cast<int>(next_group_ - 1) + std::countr_zero(blocks_left_);
        blocks_left_ &= blocks_left_ - 1U;
        unsigned found = near(pieces_.blocks()[block]);
        if (piece_ / lanes == block) found &= ~(1U << static_cast<unsigned>(piece_ % lanes));
        if (found == 0) continue;
        candidates_.push_back({block, found});
        return true;
    }
}

bool PieceVisibility::find(float u, const VisibleInterval& whole) {
    const PieceBlock& p = pieces_.block_of(piece_);
    const int k = piece_ % lanes;
    hidden_.clear();
    parts_.clear();
    rest_ = whole;
    u_ = u;
    q_w_ = p.q_w[k];
    q_0_ = p.q[k] + p.q_u[k] * (u - p.middle[k]) - q_w_ * p.w[k];
    for (std::size_t at = 0; at < candidates_.size() || find_more(); ++at) {
        if (!take_away(candidates_[at])) return false;
    }
    if (hidden_.size() > 1) {
        std::ranges::sort(hidden_, [](const VisibleInterval& a, const VisibleInterval& b) {
            return std::tie(a.low, a.high, a.high_slope) < std::tie(b.low, b.high, b.high_slope);
        });
    }
    float at = rest_.low;
    float slope = rest_.low_slope;
    for (const VisibleInterval& hidden : hidden_) {
        if (hidden.low > at + eps_) {
            if (hidden.low >= rest_.high) break;
            parts_.push_back({at, hidden.low, slope, hidden.low_slope});
        }
        if (hidden.high > at) {
            at = hidden.high;
            slope = hidden.high_slope;
        }
        if (at >= rest_.high - eps_) break;
    }
    if (rest_.high > at + eps_) parts_.push_back({at, rest_.high, slope, rest_.high_slope});
    return !parts_.empty();
}

/// Takes what a block of pieces hides from the rest; false: nothing is left.
bool PieceVisibility::take_away(const Candidate& candidate) {
    const PieceBlock& b = pieces_.blocks()[candidate.block];
    const auto load = [](const PieceBlock::Row& row) { return Floats8::load(row.data()); };
    const Floats8 u = u_;
    const Floats8 d = u - load(b.middle);
    const auto line = [&](const PieceBlock::Row& w, const PieceBlock::Row& slope) {
        return fma(load(slope), d, load(w));
    };
    const Floats8 low =
        max(max(line(b.low_a, b.low_a_slope), line(b.low_b, b.low_b_slope)), rest_.low);
    const Floats8 high =
        min(min(line(b.high_a, b.high_a_slope), line(b.high_b, b.high_b_slope)), rest_.high);
    const unsigned meets =
        ((load(b.from) <= u) & (load(b.to) > u) & (high - low > Floats8(overlap_share * eps_)))
            .bits() &
        candidate.pieces;
    if (meets == 0) return true;
    // Each is nearer by this at both ends of the overlap.
    const Floats8 q_w = load(b.q_w);
    const Floats8 q = line(b.q, b.q_u);
    const Floats8 w = load(b.w);
    const Mask8 lower =
        Ints8(pieces_.block_of(piece_).number[piece_ % lanes]) > Ints8::load(b.number.data());
    const Floats8 tie = sonarsim::where(lower, Floats8(same_depth), Floats8(-same_depth));
    const auto nearer = [&](Floats8 at) {
        const Floats8 own = fma(Floats8(q_w_), at, Floats8(q_0_));
        return fma(q_w, at - w, q) - own + tie * own;
    };
    const Floats8 at_low = nearer(low);
    const Floats8 at_high = nearer(high);
    const unsigned hides = ((at_low > Floats8(0.0F)) | (at_high > Floats8(0.0F))).bits() & meets;
    for (unsigned left = hides; left != 0; left &= left - 1U) {
        const int lane = std::countr_zero(left);
        const int j = candidate.block * lanes + lane;
        const VisibleInterval hidden{low[lane], high[lane], pieces_.low(j, u_).slope,
                                     pieces_.high(j, u_).slope};
        if (!take(j, hidden, at_low[lane], at_high[lane])) return false;
    }
    return true;
}

/// Takes the interval of piece `j` from the rest, as far as it is nearer; false: nothing is left.
bool PieceVisibility::take(int j, VisibleInterval hidden, float nearer_low, float nearer_high) {
    if (nearer_low <= 0.0F || nearer_high <= 0.0F) {
        // The planes cross within the interval.
        const PieceBlock& other = pieces_.block_of(j);
        const PieceBlock& own = pieces_.block_of(piece_);
        const float w =
            hidden.low + (hidden.high - hidden.low) * nearer_low / (nearer_low - nearer_high);
        const float by_w = other.q_w[j % lanes] - q_w_;
        const float by_u = other.q_u[j % lanes] - own.q_u[piece_ % lanes];
        const float slope = by_w != 0.0F ? -by_u / by_w : 0.0F;
        (nearer_low <= 0.0F ? hidden.low : hidden.high) = w;
        (nearer_low <= 0.0F ? hidden.low_slope : hidden.high_slope) = slope;
        if (!(hidden.high > hidden.low)) return true;
    }
    if (hidden.low <= rest_.low + eps_) {
        if (hidden.high > rest_.low) {
            rest_.low = hidden.high;
            rest_.low_slope = hidden.high_slope;
        }
    } else if (hidden.high >= rest_.high - eps_) {
        if (hidden.low < rest_.high) {
            rest_.high = hidden.low;
            rest_.high_slope = hidden.low_slope;
        }
    } else {
        hidden_.push_back(hidden);
    }
    return rest_.high - rest_.low > eps_;
}

}  // namespace sonarsim
