#include "simulate/labels/hidden_surface.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/sample_kinds.h"
#include "simulate/trace/taper.h"

namespace sonarsim {

namespace {

// Surface that is seen edge-on covers all ranges; its extent is limited to this share of its range.
constexpr float longest_half = 0.1F;

constexpr float max_parts_by_beams = 64.0F;
constexpr float max_parts_by_bins = 128.0F;

// The surface behind a part is so many bins deep.
constexpr float bins_of_part = 4.0F;

// The mean distance of the lines of shares: this share of an object's size, so that in fans some
// 400 meet it, but at least 2.5 cm at 5 m, and in thin views less. Chosen.
constexpr double share_of_size = 0.05;
constexpr double share_rad = 0.005;
constexpr double share_by_view = 0.25;

/// The k-th number of a sequence that fills (0, 1) evenly at every length.
float scattered(std::size_t k) {
    constexpr double golden = 0.6180339887498949;
    const double at = 0.5 + static_cast<double>(k) * golden;
    return static_cast<float>(at - std::floor(at));
}

SightLine line_behind(const Sample& sample, const Arrival& place, float share_u, float share_v,
                      int beam) {
    const auto& [range, direction] = place;
    return {.direction = direction,
            .before_m = range,
            .range_m = range,
            .solid_angle =
                share_u * share_v * sample.area_m2 * sample.height_m / (range * range * range),
            .sample = &sample,
            .share_u = share_u,
            .share_v = share_v,
            .beam = static_cast<std::uint32_t>(beam),
            .last_beam = static_cast<std::uint32_t>(beam)};
}

/// Makes a line cover the beams whose middles its part of the footprint covers.
void cover_beams(SightLine& line, const ConeBeams& cones) {
    const auto sine_along = [&](const Eigen::Vector3f& edge) {
        return std::fabs(edge.y() - line.direction.y() * line.direction.dot(edge)) / line.before_m;
    };
    const Sample& sample = *line.sample;
    const float beyond = line.share_u * sine_along(sample.edge_u) +
                         line.share_v * sine_along(sample.edge_v) - 0.5F * cones.mean_width();
    if (!(beyond > 0.0F)) return;
    const int first = cones.beam(line.direction.y() - beyond);
    const int last = cones.beam(line.direction.y() + beyond);
    if (first >= 0) line.beam = static_cast<std::uint32_t>(first);
    if (last >= 0) line.last_beam = static_cast<std::uint32_t>(last);
}

/// The parts of an edge of a line array's sample: each as wide as a line, and two beams along it.
float parts_of_beams(const Eigen::Vector3f& half_edge, const SightLine& line,
                     const LineWidth& width) {
    constexpr float along_beam = 2.0F;
    // In sines the middle beam of a fan of 130 degrees is 1.25 mean widths wide.
    constexpr float wider = 0.3F;
    const Eigen::Vector3f across = half_edge - line.direction * line.direction.dot(half_edge);
    const float beam_m = 0.5F * line.before_m * width.cones.mean_width();
    const float parts = std::max(std::fabs(across.y()) / static_cast<float>(width.beams),
                                 across.norm() / along_beam) /
                        beam_m;
    return parts - wider;
}

/// The parts of an edge of another sample: the surface behind each is four bins deep, or the edge
/// spans two beams where nothing is met behind the sample's middle. The plane n . x = h is met at
/// the range r = b h / (n . (p + s e)), b that of the sample, so |dr / ds| = r^2 |n . e| / (b h).
float parts_of_bins(const Eigen::Vector3f& half_edge, const SightLine& line,
                    const Intersection* met, const View& view) {
    if (met) {
        const float h = (line.before_m + met->distance_m) * met->normal.dot(line.direction);
        const float middle = line.before_m * met->normal.dot(line.direction);
        const float along = met->normal.dot(half_edge);
        const float nearest = std::max(std::fabs(middle) - std::fabs(along), 0.0F);
        const float farthest =
            std::min(line.before_m * std::fabs(h) / nearest, static_cast<float>(view.range_max_m));
        return farthest * farthest * std::fabs(along / (line.before_m * h)) /
               (bins_of_part * static_cast<float>(view.bin_m()));
    }
    const Eigen::Vector3f across = half_edge - line.direction * line.direction.dot(half_edge);
    const auto beam_rad = static_cast<float>(view.azimuth_rad / view.beams);
    return across.norm() / (beam_rad * line.before_m);
}

}  // namespace

std::vector<SightLine> sight_lines(const TracedPing& traced, const SurfaceEchoes& echoes, int beams,
                                   const KeepLine& keep) {
    const Samples& samples = traced.samples;
    std::vector<SightLine> lines;
    const auto add = [&](const Sample& sample, const Arrival& place, int beam) {
        const SightLine line = line_behind(sample, place, 1.0F, 1.0F, beam);
        if (!keep(line)) return;
        lines.push_back(line);
        if (echoes.cones.exist()) cover_beams(lines.back(), echoes.cones);
    };
    if (echoes.cones.exist()) {
        for (const Sample& sample : samples.items) {
            if (!kind_of(sample.kind).hides) continue;
            const Arrival place = arrival_of(sample.position);
            if (const int beam = echoes.cones.beam(place.direction.y()); beam >= 0)
                add(sample, place, beam);
        }
        return lines;
    }
    for (int j = 0; j < beams; ++j) {
        for (const Sample& sample : samples.beam(j)) {
            const std::ptrdiff_t k = &sample - samples.items.data();
            if (echoes.received.empty() || echoes.received[static_cast<std::size_t>(k)] != 0)
                add(sample, arrival_of(sample.position), j);
        }
    }
    return lines;
}

LineParts parts_of(const SightLine& line, const Intersection* met, const LineWidth& width) {
    const bool by_beams = width.cones.exist();
    const auto count = [&](const Eigen::Vector3f& edge) {
        const float number = by_beams ? parts_of_beams(edge, line, width)
                                      : parts_of_bins(edge, line, met, width.view);
        // The number of a surface that is seen edge-on may be NaN.
        const float most = by_beams ? max_parts_by_beams : max_parts_by_bins;
        return static_cast<int>(std::ceil(number > 1.0F ? std::min(number, most) : 1.0F));
    };
    return {count(line.sample->edge_u), count(line.sample->edge_v)};
}

LineParts parts_of_share(const SightLine& line, const View& view, float size) {
    const auto apart = static_cast<float>(std::min(
        std::max<double>(share_rad, share_of_size * size), share_by_view * view.elevation_rad));
    const auto count = [&](const Eigen::Vector3f& half_edge) {
        const float half_m = (half_edge - line.direction * line.direction.dot(half_edge)).norm();
        const float number = 2.0F * half_m / (line.before_m * apart);
        return static_cast<int>(std::ceil(std::clamp(number, 1.0F, max_parts_by_bins)));
    };
    return {count(line.sample->edge_u), count(line.sample->edge_v), true};
}

void divide(const SightLine& line, const LineParts& parts, const LineWidth& width,
            const KeepLine& keep, std::vector<SightLine>& out) {
    if (parts.u == 1 && parts.v == 1 && !parts.are_scattered) {
        out.push_back(line);
        return;
    }
    const bool by_beams = width.cones.exist();
    const Sample& sample = *line.sample;
    const float share_u = 1.0F / static_cast<float>(parts.u);
    const float share_v = 1.0F / static_cast<float>(parts.v);
    const Eigen::Vector3f middle = middle_of(sample, parts.u);
    const std::size_t first = out.size();
    for (int i = 0; i < parts.u; ++i) {
        for (int j = 0; j < parts.v; ++j) {
            const auto number = first + static_cast<std::size_t>(i * parts.v + j);
            const float aside_u = parts.are_scattered ? scattered(number) : 0.5F;
            const float aside_v = parts.are_scattered ? scattered(line.beam + 7U * i) : 0.5F;
            const float u = 2.0F * (static_cast<float>(i) + aside_u) * share_u - 1.0F;
            const float v = 2.0F * (static_cast<float>(j) + aside_v) * share_v - 1.0F;
            const float wider = 1.0F + sample.wedge * u;
            const Arrival place =
                arrival_of(middle + u * sample.edge_u + v * wider * sample.edge_v);
            const int beam =
                by_beams ? width.cones.beam(place.direction.y()) : static_cast<int>(line.beam);
            if (beam < 0) continue;
            SightLine part = line_behind(sample, place, share_u, share_v * wider, beam);
            if (by_beams) cover_beams(part, width.cones);
            if (keep(part)) out.push_back(part);
        }
    }
}

float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal,
                  const LineWidth& width) {
    const Sample& sample = *line.sample;
    // The change of the plane's range along the half edge of the footprint in front of it.
    const auto along = [&](const Eigen::Vector3f& edge) {
        const Eigen::Vector3f turn =
            (edge - line.direction * line.direction.dot(edge)) / line.before_m;
        return std::fabs(range_m * normal.dot(turn) / normal.dot(line.direction));
    };
    const float half = line.share_u * along(sample.edge_u) + line.share_v * along(sample.edge_v);
    const float max_half = width.cones.exist()
                               ? longest_half * range_m
                               : bins_of_part * static_cast<float>(width.view.bin_m());
    // The quotient may be NaN for a plane that is seen edge-on.
    return half < max_half ? half : max_half;
}

}  // namespace sonarsim
