#include "simulate/visibility/slices/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sonarsim {

namespace {

constexpr float never = std::numeric_limits<float>::infinity();
constexpr Interval everywhere{-never, never};

// Between edges that touch without common corners, rounding opens cracks of the width of a float's
// step. Spans narrower than this are such cracks.
constexpr float narrowest_span = 2e-6F;

// A narrow span is not a crack if a whole face is as narrow and spans this share of its range: it
// may have more area than all other surface in its bins.
constexpr float min_depth = 1e-4F;

/// A sweep over w. One segment is on top; those below it are open.
class Sweep {
  public:
    Sweep(std::span<const Segment> segments, const SliceScene& scene, const Slice& slice,
          FacetExtents& facet_extents, std::vector<std::uint32_t>& open,
          std::vector<VisibleSpan>& out)
        : segments_(segments),
          scene_(scene),
          slice_(slice),
          facet_extents_(facet_extents),
          open_(open),
          out_(out) {
        open_.clear();
    }

    void run() {
        std::uint32_t next = 0;
        const auto count = static_cast<std::uint32_t>(segments_.size());
        while (next < count || top_ != none) {
            const float start =
                next < count ? std::max(segments_[next].w_low, slice_.w_low) : never;
            const float end = top_ == none ? never : std::min(top().w_high, slice_.w_high);
            if (start <= std::min(end, crossing_)) {
                if (start >= slice_.w_high) {
                    if (top_ == none) return;
                    next = count;
                    continue;
                }
                begin_segment(next++, start);
            } else if (crossing_ < end) {
                const std::uint32_t above = crosses_;
                replace_top(above, crossing_, crossing_border(top_, above));
            } else {
                end_top(end);
            }
        }
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFFU;

    const Segment& top() const { return segments_[top_]; }

    void begin_segment(std::uint32_t s, float w) {
        const Segment& segment = segments_[s];
        if (segment.w_high <= w) return;
        const bool at_border = segment.w_low < w;
        const Trapezoid& trapezoid = scene_.trapezoids[segment.trapezoid];
        const Border border =
            at_border ? Border{slice_.w_low_slope, never, everywhere}
                      : Border{trapezoid.low.w_slope, segment.q_at(w), trapezoid.low.extent};
        if (top_ == none) {
            set_top(s, w, border);
            return;
        }
        const float q = segment.q_at(w);
        const float q_top = top().q_at(w);
        if (q > q_top || (q == q_top && segment.q_slope > top().q_slope)) {
            replace_top(s, w, border);
        } else {
            open_.push_back(s);
            note_crossing(s, w);
        }
    }

    void set_top(std::uint32_t s, float w, const Border& border) {
        top_ = s;
        begin_ = w;
        begin_border_ = border;
        crossing_ = never;
    }

    /// Makes `s` the top at w, where it rises above the old top; that point moves with `border`.
    void replace_top(std::uint32_t s, float w, const Border& border) {
        emit(w, border);
        const std::uint32_t below = top_;
        set_top(s, w, border);
        if (segments_[below].w_high > w) open_.push_back(below);
        find_crossing(w);
    }

    void end_top(float w) {
        const bool at_border = top().w_high > w;
        const Trapezoid& trapezoid = scene_.trapezoids[top().trapezoid];
        const Border border =
            at_border ? Border{slice_.w_high_slope, never, everywhere}
                      : Border{trapezoid.high.w_slope, top().q_at(w), trapezoid.high.extent};
        emit(w, border);
        top_ = none;
        crossing_ = never;
        if (at_border) {
            open_.clear();
            return;
        }
        float best = -never;
        float best_slope = -never;
        std::uint32_t next = none;
        std::erase_if(open_, [&](std::uint32_t s) { return segments_[s].w_high <= w; });
        for (const std::uint32_t s : open_) {
            const float q = segments_[s].q_at(w);
            const float q_slope = segments_[s].q_slope;
            if (q > best || (q == best && q_slope > best_slope)) {
                best = q;
                best_slope = q_slope;
                next = s;
            }
        }
        if (next == none) return;
        set_top(next, w, border);
        find_crossing(w);
    }

    /// Finds the first open segment that rises above the top after w.
    void find_crossing(float w) {
        std::erase_if(open_,
                      [&](std::uint32_t s) { return s == top_ || segments_[s].w_high <= w; });
        for (const std::uint32_t s : open_)
            note_crossing(s, w);
    }

    void note_crossing(std::uint32_t s, float w) {
        const Segment& segment = segments_[s];
        const float faster = segment.q_slope - top().q_slope;
        if (!(faster > 0.0F)) return;
        const float behind = std::max(top().q_at(w) - segment.q_at(w), 0.0F);
        const float at = w + behind / faster;
        if (at < crossing_ && at < std::min(segment.w_high, top().w_high)) {
            crossing_ = at;
            crosses_ = s;
        }
    }

    /// The line in which two planes cross. On a plane -h q = n . (1, u, w).
    Border crossing_border(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t s = scene_.trapezoids[segments_[a].trapezoid].facet_index;
        const std::uint32_t t = scene_.trapezoids[segments_[b].trapezoid].facet_index;
        const FrontFacet& f = scene_.facets[s];
        const FrontFacet& g = scene_.facets[t];
        const Eigen::Vector3f difference = f.normal * g.height_m - g.normal * f.height_m;
        const float slope = -difference.y() / difference.z();
        const Interval u = facet_extents_.of(s).u;
        const Interval v = facet_extents_.of(t).u;
        return {std::isfinite(slope) ? slope : 0.0F,
                segments_[b].q_at(crossing_),
                {std::max(u.from, v.from), std::min(u.to, v.to)}};
    }

    /// True if the span that ends at w is the top's whole segment, which is narrow because its face
    /// is edge-on.
    bool is_edge_on_face(float w) const {
        if (!(begin_ < w && top().w_low == begin_ && top().w_high == w)) return false;
        const float q = top().q_at(w);
        return std::fabs(q - top().q_at(begin_)) > min_depth * q;
    }

    void emit(float w, const Border& border) {
        if (!(w - begin_ > narrowest_span * (1.0F + std::fabs(w))) && !is_edge_on_face(w)) return;
        const std::uint32_t facet_index = scene_.trapezoids[top().trapezoid].facet_index;
        out_.push_back({begin_, w, top().q_at(begin_), top().q_at(w), begin_border_, border,
                        facet_extents_.of(facet_index), facet_index});
    }

    std::span<const Segment> segments_;
    const SliceScene& scene_;
    const Slice& slice_;
    FacetExtents& facet_extents_;
    std::vector<std::uint32_t>& open_;  ///< segments below the top; some may have ended
    std::vector<VisibleSpan>& out_;
    std::uint32_t top_ = none;
    float begin_ = 0.0F;  ///< begin of the top's visible span
    Border begin_border_{};
    float crossing_ = never;  ///< w at which an open segment rises above the top
    std::uint32_t crosses_ = none;
};

}  // namespace

void visible_spans(std::span<const Segment> segments, const SliceScene& scene, const Slice& slice,
                   FacetExtents& facet_extents, std::vector<std::uint32_t>& open,
                   std::vector<VisibleSpan>& out) {
    out.clear();
    Sweep(segments, scene, slice, facet_extents, open, out).run();
}

}  // namespace sonarsim
