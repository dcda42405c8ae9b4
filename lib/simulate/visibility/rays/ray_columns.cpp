#include "simulate/visibility/rays/ray_columns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

namespace sonarsim {

namespace {

// A surface nearer than this share of the greatest range touches the sonar: in float (positions in
// view are rounded to 2^-24 of that range) its distance is 0 and it has no direction.
constexpr float nearest_share = 0x1p-23F;

/// Two neighbouring rays of a column with an uncertain surface between them.
struct Gap {
    int column;
    int below;
    int above;
};

/// Casts the columns of some beams. Holds the shared state of the steps of one call.
class ColumnCaster {
  public:
    ColumnCaster(const Caster& caster, const View& view, const LocalPose& pose,
                 const Sampling& sampling, BeamRange beams, const BentWater& water, RayColumns& out)
        : caster_(caster),
          water_(water),
          view_(view),
          pose_(pose),
          sampling_(sampling),
          reach_m_(static_cast<float>(view.range_max_m)),
          view_columns_(view_columns(view, sampling.columns)),
          out_(out) {
        std::erase_if(view_columns_, [beams](const ViewColumn& column) {
            return column.beam < beams.begin || column.beam >= beams.end;
        });
        out_.whole_columns = view_columns_.size();
    }

    void cast_whole_columns() {
        // Reserves space for the edge strips and the splits, so that the rays are seldom moved.
        out_.rays.reserve(4 * view_columns_.size() * sampling_.rays);
        for (const ViewColumn& column : view_columns_) {
            add_column(column, column.across, 0.5 * column.width, 0, sampling_.rays, true);
        }
        cast(in_tiles());
    }

    /// Casts edge strips over those parts of a column that disagree with a neighbour.
    void cast_edge_strips() {
        const int n = sampling_.rays;
        out_.narrowed.assign(out_.whole_columns * n, 0);
        if (!sampling_.edge_strips) return;
        for (std::size_t c = 0; c < out_.whole_columns; ++c) {
            const std::size_t beside = neighbour(c);
            if (beside == c) continue;
            for (int i = 0; i < n; ++i) {
                const std::size_t a = c * n + i;
                const std::size_t b = beside * n + i;
                if (disagree(out_.rays[a], out_.rays[b], sampling_, reach_m_))
                    out_.narrowed[a] = out_.narrowed[b] = 1;
            }
        }
        for (std::size_t c = 0; c < out_.whole_columns; ++c) {
            const auto* narrowed = out_.narrowed.data() + c * n;
            for (int i = 0; i < n; ++i) {
                if (!narrowed[i]) continue;
                const int first = i;
                while (i < n && narrowed[i])
                    ++i;
                const double half = 0.5 * view_columns_[c].width;
                for (const double side : {-1.0, 1.0}) {
                    add_column(view_columns_[c],
                               view_columns_[c].across + side * (1.0 - edge_strip_share) * half,
                               edge_strip_share * half, first, i, false);
                }
            }
        }
        cast_new_rays();
    }

    /// Splits the gaps between neighbouring rays until each is certain enough.
    void split_gaps() {
        std::vector<Gap> gaps;
        const auto estimate_above = [&](int column, int below) {
            const int above = out_.rays[below].next;
            if (above != CastRay::none) estimate({column, below, above}, 0, gaps);
        };
        for (const int ray : in_tiles())
            estimate_above(ray / sampling_.rays, ray);
        for (std::size_t c = out_.whole_columns; c < out_.columns.size(); ++c) {
            for (int i = out_.columns[c].first; i != CastRay::none; i = out_.rays[i].next) {
                estimate_above(static_cast<int>(c), i);
            }
        }
        std::vector<Gap> next_gaps;
        for (int level = 0; level < sampling_.split_levels && !gaps.empty(); ++level) {
            const int first = static_cast<int>(out_.rays.size());
            for (const Gap& gap : gaps) {
                const float along =
                    split_angle(out_.rays[gap.below], out_.rays[gap.above], reach_m_);
                add_ray(out_.columns[gap.column].across, sincos_small(along), along);
            }
            cast_new_rays();
            next_gaps.clear();
            for (int k = 0; k < static_cast<int>(gaps.size()); ++k) {
                const Gap& gap = gaps[k];
                out_.rays[gap.below].next = first + k;
                out_.rays[first + k].next = gap.above;
                estimate({gap.column, gap.below, first + k}, level + 1, next_gaps);
                estimate({gap.column, first + k, gap.above}, level + 1, next_gaps);
            }
            std::swap(gaps, next_gaps);
        }
    }

  private:
    /// The column next to column c on its positive side; c itself if there is none.
    std::size_t neighbour(std::size_t c) const {
        if (view_.shape == ViewShape::cone) return (c + 1) % out_.whole_columns;
        const bool last = c + 1 == out_.whole_columns;
        const bool other_side = !last && view_.shape == ViewShape::port_starboard &&
                                view_columns_[c].beam != view_columns_[c + 1].beam;
        return last || other_side ? c : c + 1;
    }

    /// Adds the rays [begin, end) of a column at the angle `across`.
    void add_column(const ViewColumn& column, double across, double half_width, int begin, int end,
                    bool whole) {
        const double step = sampling_.step(column.along_max - column.along_min);
        const auto at = [&](double i) {
            return static_cast<float>(column.along_min + (sampling_.inset + i) * step);
        };
        const SinCosFloat middle = sincos_float(across);
        const float along_min = begin == 0 ? static_cast<float>(column.along_min) : at(begin - 0.5);
        const float along_max =
            end == sampling_.rays ? static_cast<float>(column.along_max) : at(end - 0.5);
        out_.columns.push_back({.beam = column.beam,
                                .half_width = static_cast<float>(half_width),
                                .across = middle,
                                .along_min = along_min,
                                .along_max = along_max,
                                .step = static_cast<float>(step),
                                .first = static_cast<int>(out_.rays.size()),
                                .whole = whole});
        for (int i = begin; i < end; ++i) {
            add_ray(middle, sincos_small(at(i)), at(i));
            if (i + 1 < end) out_.rays.back().next = static_cast<int>(out_.rays.size());
        }
    }

    void add_ray(SinCosFloat across, SinCosFloat along, float angle) {
        out_.rays.push_back({direction(view_.shape, across, along), angle});
    }

    /// The rays of the whole columns, in tiles. Rays with similar directions traverse Embree's tree
    /// together, twice as fast as column by column. A packet of a fan has one elevation, since at
    /// grazing incidence neighbours in azimuth meet closer surface than those in elevation.
    std::vector<int> in_tiles() const {
        const int across = view_.shape == ViewShape::fan ? 8 : 4;
        constexpr int along = 4;
        const int columns = static_cast<int>(out_.whole_columns);
        const int n = sampling_.rays;
        std::vector<int> order;
        order.reserve(static_cast<std::size_t>(columns) * n);
        for (int c0 = 0; c0 < columns; c0 += across) {
            for (int i0 = 0; i0 < n; i0 += along) {
                for (int i = i0; i < std::min(i0 + along, n); ++i) {
                    for (int c = c0; c < std::min(c0 + across, columns); ++c) {
                        order.push_back(c * n + i);
                    }
                }
            }
        }
        return order;
    }

    void cast_new_rays() {
        std::vector<int> order(out_.rays.size() - cast_count_);
        std::iota(order.begin(), order.end(), static_cast<int>(cast_count_));
        cast(order);
    }

    /// Casts the rays that have not been cast, in the given order.
    void cast(const std::vector<int>& order) {
        const std::size_t count = order.size();
        directions_.resize(count);
        facets_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            directions_[i] = pose_.rotation * out_.rays[order[i]].direction;
        }
        if (water_.profile) return cast_bent(order);
        caster_.cast(pose_.position, directions_, reach_m_ * (1.0F + overreach), facets_);
        const Eigen::Matrix3f R_sensor_local = pose_.rotation.transpose();
        for (std::size_t i = 0; i < count; ++i) {
            CastRay& ray = out_.rays[order[i]];
            ray.facet = facets_[i];
            if (ray.missed()) continue;
            const Facet facet = caster_.facet(ray.facet);
            const float height = facet.normal.dot(pose_.position - facet.vertex);
            const float side = height < 0.0F ? -1.0F : 1.0F;
            ray.normal = R_sensor_local * (side * facet.normal);
            ray.height_m = side * height;
            ray.cosine = -ray.normal.dot(ray.direction);
            ray.range_m = ray.height_m / ray.cosine;
            ray.material = facet.material;
            ray.instance = facet.instance;
            drop_unless_seen(ray, ray.cosine);
        }
        cast_count_ = out_.rays.size();
    }

    /// Drops a ray whose plane is edge-on to within rounding, which has no range and reflects
    /// nothing, or touches the sonar. `cosine`: the least of its cosines.
    void drop_unless_seen(CastRay& ray, float cosine) {
        if (cosine > 1e-7F && ray.range_m > nearest_share * reach_m_) return;
        ray.facet = Caster::nothing;
        ++out_.dropped;
    }

    /// The same along bent rays: a ray gets the apparent plane of the surface.
    void cast_bent(const std::vector<int>& order) {
        std::vector<BentHit> hits(order.size());
        cast_bent_rays(caster_, water_, pose_.position, directions_, {},
                       reach_m_ * (1.0F + overreach), hits);
        const Eigen::Matrix3f R_sensor_local = pose_.rotation.transpose();
        out_.tubes.resize(out_.rays.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const BentHit& hit = hits[i];
            if (hit.facet == Caster::nothing) continue;
            CastRay& ray = out_.rays[order[i]];
            ray.facet = hit.facet;
            ray.normal = R_sensor_local * hit.normal;
            ray.cosine = hit.cosine;
            ray.range_m = hit.range_m;
            ray.height_m = hit.cosine * hit.range_m;
            const Facet facet = caster_.facet(hit.facet);
            ray.material = facet.material;
            ray.instance = facet.instance;
            out_.tubes[order[i]] = hit.tube;
            out_.tubes[order[i]].normal = R_sensor_local * hit.tube.normal;
            drop_unless_seen(ray, std::min(hit.cosine, hit.tube.cosine));
        }
        cast_count_ = out_.rays.size();
    }

    /// Stores the estimate of a gap split `level` times, and adds it to `gaps` if it must be split.
    void estimate(const Gap& gap, int level, std::vector<Gap>& gaps) {
        CastRay& below = out_.rays[gap.below];
        const GapEstimate found = estimate_gap(below, out_.rays[gap.above], sampling_, reach_m_);
        below.continuous = found.continuous;
        below.border = found.border;
        if (found.range_uncertainty_m > sampling_.range_uncertainty_m ||
            (found.bends && level < sampling_.bend_levels)) {
            gaps.push_back(gap);
        }
    }

    const Caster& caster_;
    const BentWater& water_;
    const View& view_;
    const LocalPose& pose_;
    const Sampling& sampling_;
    const float reach_m_;
    std::vector<ViewColumn> view_columns_;  ///< the columns of the beams
    RayColumns& out_;
    std::size_t cast_count_ = 0;  ///< number of rays cast so far
    std::vector<Eigen::Vector3f> directions_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace

RayColumns cast_ray_columns(const Caster& caster, const View& view, const LocalPose& pose,
                            const Sampling& sampling, BeamRange beams, const BentWater& water) {
    RayColumns out;
    ColumnCaster columns(caster, view, pose, sampling, beams, water, out);
    columns.cast_whole_columns();
    columns.cast_edge_strips();
    columns.split_gaps();
    return out;
}

}  // namespace sonarsim
