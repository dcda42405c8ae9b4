#include "visibility/slices/extra_slices.h"

#include <algorithm>

namespace sonarsim {

namespace {

// Over the width of a hidden piece: the facets of a wire face all ways, and its brightness is their
// mean.
constexpr int slices_per_piece = 3;

// Between two slices. Pieces that are more crowded share theirs.
constexpr int most_places = 1;

/// Where pieces hide: the gap before a slice, and the part of it.
struct Place {
    std::int32_t slice;
    Extent u;
    Extent w;
};

/// The extents of hidden pieces, those that overlap as one, in order.
std::vector<Place> places_of(const SliceScene& scene) {
    std::vector<Place> all;
    for (const Between& between : scene.between) {
        if (!scene.met[between.piece]) all.push_back({between.slice, between.u, between.w});
    }
    std::ranges::sort(all, [](const Place& a, const Place& b) {
        return a.slice < b.slice || (a.slice == b.slice && a.u.from < b.u.from);
    });
    std::vector<Place> places;
    int in_gap = 0;
    for (const Place& place : all) {
        const bool same_gap = !places.empty() && places.back().slice == place.slice;
        in_gap = same_gap ? in_gap : 0;
        if (same_gap && (place.u.from <= places.back().u.to || in_gap == most_places)) {
            Place& last = places.back();
            last.u.to = std::max(last.u.to, place.u.to);
            last.w = {std::min(last.w.from, place.w.from), std::max(last.w.to, place.w.to)};
        } else {
            places.push_back(place);
            ++in_gap;
        }
    }
    return places;
}

/// A slice at `share` of the way between two, with their borders of the view.
Slice between(const Slice& a, const Slice& b, float u) {
    const float share = (u - a.u) / (b.u - a.u);
    const auto mix = [&](float x, float y) { return x + share * (y - x); };
    Slice slice{};
    slice.u = u;
    slice.w_low = mix(a.w_low, b.w_low);
    slice.w_high = mix(a.w_high, b.w_high);
    slice.w_low_slope = mix(a.w_low_slope, b.w_low_slope);
    slice.w_high_slope = mix(a.w_high_slope, b.w_high_slope);
    slice.strips = 1;
    slice.extra = true;
    return slice;
}

}  // namespace

bool add_extra_slices(const SliceScene& scene, SliceFrame& frame) {
    const std::vector<Place> places = places_of(scene);
    if (places.empty()) return false;
    std::vector<Slice> slices;
    auto place = places.begin();
    for (std::size_t s = 0; s < frame.slices.size(); ++s) {
        for (; place != places.end() && place->slice == static_cast<std::int32_t>(s); ++place) {
            const Extent extent = place->u;
            const float step = (extent.to - extent.from) / slices_per_piece;
            // The gap belongs to the beam after the slice before it.
            const Slice& before = frame.slices[s - 1];
            const int beam = before.strip[before.strips - 1].beam;
            for (int k = 0; k < slices_per_piece; ++k) {
                const float from = extent.from + static_cast<float>(k) * step;
                Slice slice = between(before, frame.slices[s], from + 0.5F * step);
                slice.strip[0] = {beam, from, from + step};
                if (slice.w_low < place->w.from) {
                    slice.w_low = place->w.from;
                    slice.w_low_slope = 0.0F;
                }
                if (slice.w_high > place->w.to) {
                    slice.w_high = place->w.to;
                    slice.w_high_slope = 0.0F;
                }
                slices.push_back(slice);
            }
        }
        slices.push_back(frame.slices[s]);
    }
    frame.slices = std::move(slices);
    return true;
}

}  // namespace sonarsim
