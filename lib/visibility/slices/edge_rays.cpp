#include "visibility/slices/edge_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/random.h"
#include "visibility/slices/scan.h"

namespace sonarsim {

namespace {

constexpr PhiloxKey edge_key{0x65646765U, 0};

// A bin is tested if it has less surface than this share of its fuller neighbour's. Chosen.
constexpr float looked_at_share = 0.1F;

// In bins. Rounding decides whether a sample fills a bin that it reaches into by less than this.
constexpr float rounding = 0.002F;
constexpr float widest_slack = 0.5F;

// A sample that would have to change its length by more than this share is left alone. Chosen.
constexpr float most_change = 0.5F;

// Most edge bins are right, and a single ray that ends in the bin shows it, so rays are cast in
// rounds. Chosen.
constexpr int rays_per_round = 8;
constexpr int most_rounds = 8;

/// The samples of one beam and the surface in its bins. Ranges are in bins.
class BeamEdges {
  public:
    BeamEdges(const Caster& caster, const View& view, const LocalPose& pose, int beam,
              const SampledImage& image, std::span<Sample> samples)
        : caster_(caster), view_(view), pose_(pose), beam_(beam), image_(image), samples_(samples) {
        for (const Sample& sample : samples_)
            spans_.push_back(span_of(sample));
    }

    /// Tests the bins of the beam with rays, and moves the ends of samples accordingly.
    void settle(std::span<EdgeBin> edges) {
        for (int bin = 0; bin < view_.range_bins; ++bin) {
            if (!(area(beam_, bin) < looked_at_share * fullest_neighbour(bin))) continue;
            collect(bin);
            if (near_.empty()) continue;
            const bool filled = any_ray_meets(bin);
            edges[bin] = filled ? EdgeBin::filled : EdgeBin::dark;
            for (const std::uint32_t k : near_)
                move_end(k, bin, filled);
        }
    }

  private:
    /// The ranges of a sample, in bins, and the largest distance of the sample's ends in an image
    /// from these. An image cuts a patch into pieces that are all as deep as the pieces at its
    /// middle (paper/footprint.cpp). Along a half edge e of depth d the range is r + d s + c s^2, s
    /// in [-1, 1], with c = (e^2 - d^2) / (2 r). The first of n pieces begins 2 c (n - 1) / n^2
    /// before the patch, at most c / 2. Two edges u and v of depths d and f add a term of at most
    /// (u . v - d f) / r.
    struct SampleSpan {
        Interval bins;
        float slack;
    };

    SampleSpan span_of(const Sample& sample) const {
        const float range = sample.position.norm();
        const float d = sample.position.dot(sample.edge_u) / range;
        const float f = sample.position.dot(sample.edge_v) / range;
        const float across =
            sample.edge_u.squaredNorm() - d * d + sample.edge_v.squaredNorm() - f * f;
        const float both = std::fabs(sample.edge_u.dot(sample.edge_v) - d * f);
        const float bends = (0.25F * std::max(across, 0.0F) + both) / range;
        const float bend_bins = bends / static_cast<float>(view_.bin_m());
        return {bins_of(view_, sample), std::min(rounding + bend_bins, widest_slack)};
    }

    float area(int beam, int bin) const {
        const bool inside = bin >= 0 && bin < view_.range_bins && beam >= 0 && beam < view_.beams;
        return inside ? image_.area[static_cast<std::size_t>(beam) * view_.range_bins + bin] : 0.0F;
    }

    float fullest_neighbour(int bin) const {
        const float in_beam = std::max(area(beam_, bin - 1), area(beam_, bin + 1));
        if (view_.shape != ViewShape::fan) return in_beam;
        return std::max({in_beam, area(beam_ - 1, bin), area(beam_ + 1, bin)});
    }

    /// Lists the samples that reach into a bin or touch it.
    void collect(int bin) {
        near_.clear();
        const auto low = static_cast<float>(bin);
        for (std::uint32_t k = 0; k < spans_.size(); ++k) {
            const auto& [box, slack] = spans_[k];
            if (box.to > low - slack && box.from < low + 1.0F + slack && samples_[k].area_m2 > 0.0F)
                near_.push_back(k);
        }
    }

    /// Casts rays to the listed samples. If some end in the bin, only their samples stay listed.
    bool any_ray_meets(int bin) {
        std::vector<std::uint32_t> met;
        for (int round = 0; round < most_rounds && met.empty(); ++round) {
            std::array<std::uint32_t, rays_per_round> aims;
            std::array<Eigen::Vector3f, rays_per_round> directions;
            std::array<std::uint32_t, rays_per_round> facets;
            for (int ray = 0; ray < rays_per_round; ++ray) {
                const auto number = static_cast<std::uint32_t>(round * rays_per_round + ray);
                aims[ray] = near_[number % near_.size()];
                directions[ray] = (pose_.rotation * point_in(bin, aims[ray], number)).normalized();
            }
            caster_.cast(pose_.position, directions, 1.01F * static_cast<float>(view_.range_max_m),
                         facets);
            for (int ray = 0; ray < rays_per_round; ++ray) {
                if (ends_in(bin, directions[ray], facets[ray])) met.push_back(aims[ray]);
            }
        }
        if (met.empty()) return false;
        near_ = std::move(met);
        return true;
    }

    /// The range at which a ray is aimed: in the bin, and most often near the border that the
    /// sample crosses or touches, since slivers of any depth must be met.
    static float aimed_range(int bin, const SampleSpan& span, float draw) {
        const auto& [box, slack] = span;
        const auto low = static_cast<float>(bin);
        const float high = low + 1.0F;
        const float middle = 0.5F * (box.from + box.to);
        const float cubed = draw * draw * draw;
        if (middle < low) return low + std::clamp(box.to - low, slack, 1.0F) * cubed;
        if (middle > high) return high - std::clamp(high - box.from, slack, 1.0F) * cubed;
        const float from = std::max(box.from, low);
        return from + (std::min(box.to, high) - from) * draw;
    }

    /// A point in the plane of sample k, sensor frame, at a range in the bin.
    Eigen::Vector3f point_in(int bin, std::uint32_t k, std::uint32_t number) const {
        const PhiloxBlock draw =
            philox({number, static_cast<std::uint32_t>(bin), static_cast<std::uint32_t>(beam_), 0},
                   edge_key);
        const Sample& sample = samples_[k];
        const float target_m =
            aimed_range(bin, spans_[k], unit_float(draw.x0)) * static_cast<float>(view_.bin_m()) +
            static_cast<float>(view_.range_min_m);
        const float range = sample.position.norm();
        const float off_m = target_m - range;
        const float u = sample.position.dot(sample.edge_u) / range;
        const float v = sample.position.dot(sample.edge_v) / range;
        const bool by_u = std::fabs(u) > std::fabs(v);
        const Eigen::Vector3f& deeper = by_u ? sample.edge_u : sample.edge_v;
        const Eigen::Vector3f& other = by_u ? sample.edge_v : sample.edge_u;
        const float deep = by_u ? u : v;
        const float flat = by_u ? v : u;
        if (!(std::fabs(deep) > 0.0F)) return sample.position;
        // off = deep s + flat t, with both shares in [-1, 1] on the sample. Half of the t are drawn
        // among those with an s in [-1, 1], the rest freely: the sample is a parallelogram, and the
        // tip of the true surface may lie at another corner.
        float t_low = -1.0F;
        float t_high = 1.0F;
        if (draw.x2 % 2 == 0 && std::fabs(flat) > 1e-6F * std::fabs(deep)) {
            const float middle = off_m / flat;
            const float reach = std::fabs(deep / flat);
            t_low = std::clamp(middle - reach, -1.0F, 1.0F);
            t_high = std::clamp(middle + reach, -1.0F, 1.0F);
        }
        const float t = t_low + (t_high - t_low) * unit_float(draw.x1);
        Eigen::Vector3f point = sample.position + t * other + (off_m - flat * t) / deep * deeper;
        // The range is not linear in s. After two steps of Newton's method only rounding is left.
        for (int step = 0; step < 2; ++step) {
            const float at = point.norm();
            point += (target_m - at) * at / point.dot(deeper) * deeper;
        }
        return point;
    }

    bool ends_in(int bin, const Eigen::Vector3f& direction, std::uint32_t index) const {
        if (index == Caster::nothing) return false;
        const Facet facet = caster_.facet(index);
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        const double range = normal.dot((facet.vertex - pose_.position).cast<double>()) /
                             normal.dot(direction.cast<double>());
        const double at = (range - view_.range_min_m) / view_.bin_m();
        return at >= bin && at < bin + 1 &&
               beam_of(view_, pose_.rotation.transpose() * direction) == beam_;
    }

    /// Moves the end of sample k that is at the border of a bin: into the bin if it is filled, else
    /// out of it. A sample that lies within a dark bin is removed.
    void move_end(std::uint32_t k, int bin, bool filled) {
        const auto low = static_cast<float>(bin);
        Sample& sample = samples_[k];
        constexpr int most_steps = 3;
        for (int step = 0; step < most_steps; ++step) {
            const auto [box, slack] = spans_[k];
            const bool below = 0.5F * (box.from + box.to) < low + 0.5F;
            const float in = below ? box.to - low : low + 1.0F - box.from;
            if (filled ? in >= slack : in <= -slack) return;
            const float wanted = filled ? 1.5F * slack : -1.5F * slack;
            const float length = box.to - box.from;
            if (!filled && in >= length) {
                sample.area_m2 = 0.0F;
                return;
            }
            if (!(length > rounding)) return;
            const float share = 1.0F + (wanted - in) / length;
            if (!(std::fabs(share - 1.0F) < most_change)) return;
            const float way = (below ? 1.0F : -1.0F) * (share - 1.0F);
            const auto deeper = [&](const Eigen::Vector3f& edge) {
                return sample.position.dot(edge) < 0.0F ? -way : way;
            };
            sample.position +=
                deeper(sample.edge_u) * sample.edge_u + deeper(sample.edge_v) * sample.edge_v;
            sample.edge_u *= share;
            sample.edge_v *= share;
            sample.area_m2 *= share;
            spans_[k] = span_of(sample);
        }
    }

    const Caster& caster_;
    const View& view_;
    const LocalPose& pose_;
    const int beam_;
    const SampledImage& image_;
    const std::span<Sample> samples_;
    std::vector<SampleSpan> spans_;
    std::vector<std::uint32_t> near_;  ///< listed samples
};

/// Removes samples without area.
void remove_empty(Samples& samples) {
    std::uint32_t kept = 0;
    std::uint32_t next = 0;
    for (std::size_t j = 1; j < samples.beam_begin.size(); ++j) {
        for (; next < samples.beam_begin[j]; ++next) {
            if (samples.items[next].area_m2 > 0.0F) samples.items[kept++] = samples.items[next];
        }
        samples.beam_begin[j] = kept;
    }
    samples.items.resize(kept);
}

}  // namespace

std::vector<EdgeBin> settle_edge_bins(const Caster& caster, const View& view, const LocalPose& pose,
                                      const SampledImage& image, Samples& samples) {
    const auto range_bins = static_cast<std::size_t>(view.range_bins);
    std::vector<EdgeBin> edges(image.area.size(), EdgeBin::not_tested);
    for (int beam = 0; beam < view.beams; ++beam) {
        const std::uint32_t begin = samples.beam_begin[beam];
        const std::uint32_t count = samples.beam_begin[beam + 1] - begin;
        if (count == 0) continue;
        BeamEdges(caster, view, pose, beam, image, std::span(samples.items).subspan(begin, count))
            .settle(std::span(edges).subspan(beam * range_bins, range_bins));
    }
    remove_empty(samples);
    return edges;
}

double share_in_dark_bins(const SampledImage& image, std::span<const EdgeBin> edges) {
    double all = 0.0;
    double dark = 0.0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto intensity = static_cast<double>(image.intensity(k));
        all += intensity;
        if (edges[k] == EdgeBin::dark) dark += intensity;
    }
    return all > 0.0 ? dark / all : 0.0;
}

}  // namespace sonarsim
