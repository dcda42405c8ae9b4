// The masks of objects in the calibrated model lie where its beams, cones, receive the echo.

#include "labels/cone_fan.h"

namespace {

/// Bins along x, beams along y, half-open.
using Box = Eigen::AlignedBox2i;

double area(const Box& box) {
    return box.isEmpty() ? 0.0 : static_cast<double>(box.sizes().x()) * box.sizes().y();
}

double overlap(const Box& a, const Box& b) {
    const double both = area(a.intersection(b));
    return both / (area(a) + area(b) - both);
}

/// A thing, and a pitched sonar in whose view it is.
struct Thing {
    Scene scene = empty_scene();
    Pose pose;
};

Thing draw_thing(Uniform& draw) {
    Thing out;
    const double tilt = radians(draw.between(0.0, 40.0));
    const double elevation = radians(draw.between(-38.0, 38.0));
    const double azimuth = radians(draw.between(-40.0, 40.0));
    const double range = draw.between(3.0, 7.0);
    out.pose = pitched(degrees(tilt));
    const Eigen::Vector3f at =
        (out.pose.rotation * (range * direction_of(azimuth, elevation))).cast<float>();
    const std::uint32_t m = add_material(out.scene, 0.4F);
    out.scene.materials[m].slope_rms_deg = 0.0F;  // Lambert's law alone
    if (draw.between(0.0, 1.0) < 0.5) {
        add_sphere(out.scene, at, static_cast<float>(draw.between(0.6, 1.0)), m, 32);
        return out;
    }
    const auto side = [&] { return static_cast<float>(draw.between(0.4, 0.8)); };
    const Eigen::Vector3f half(side(), side(), side());
    add_box(out.scene, at - half, at + half, m);
    return out;
}

/// The energy by Lambert's law in each bin, [range bins, beams]: of many points of each sample, for
/// each of which range and sine say where the array receives it.
std::vector<double> energies_of_points(const TracedPing& traced, const Sonar& sonar) {
    const View& view = sonar.settings.view;
    std::vector<double> energies(static_cast<std::size_t>(view.range_bins) * view.beams);
    for (const Sample& sample : traced.samples.items) {
        const Eigen::Vector3f to = sample.position.normalized();
        // Four points to a bin, and to the width of the sample in beams.
        const auto points_along = [&](const Eigen::Vector3f& half_edge) {
            const double depth_m = 2.0 * std::fabs(half_edge.dot(to));
            return 8 + static_cast<int>(4.0 * depth_m / view.bin_m());
        };
        const int rows = points_along(sample.edge_u);
        const int columns = points_along(sample.edge_v);
        const auto at = [](int i, int n) {
            return (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(n) - 1.0F;
        };
        for (int row = 0; row < rows; ++row) {
            const float width = 1.0F + sample.wedge * at(row, rows);
            const Eigen::Vector3f middle = middle_of(sample, rows) + at(row, rows) * sample.edge_u;
            for (int column = 0; column < columns; ++column) {
                const Eigen::Vector3f p = middle + width * at(column, columns) * sample.edge_v;
                const double r = p.norm();
                const int beam = beam_at(sonar, p.y() / r);
                if (beam < 0 || r < view.range_min_m || r >= view.range_max_m) continue;
                const double sine = sample.height_m / r;
                energies[static_cast<std::size_t>(bin_at(sonar, r)) * view.beams + beam] +=
                    width * sample.area_m2 * sine * sine / (r * r * r * r * rows * columns);
            }
        }
    }
    return energies;
}

/// The energies of the echoes that labels are made of, likewise.
std::vector<double> energies_of_labels(const TracedPing& traced, const Sonar& sonar,
                                       const Scene& scene) {
    const View& view = sonar.settings.view;
    const std::array<std::uint32_t, EchoBlock::capacity> one_source{};
    EchoSums sums(range_bins(view), view.beams);
    sonar.settings.model->surface_echoes(
        traced, view, scene, {}, [&](const EchoBlock& echoes) { sums.add(echoes, one_source); });
    std::vector<double> energies(static_cast<std::size_t>(view.range_bins) * view.beams);
    for (int j = 0; j < view.beams; ++j) {
        std::vector<float> column(view.range_bins);
        sums.add_to(0, j, column);
        for (int i = 0; i < view.range_bins; ++i)
            energies[static_cast<std::size_t>(i) * view.beams + j] = column[i];
    }
    return energies;
}

/// The box of the bins above some energy, of those in the mask if there is one.
Box box_above(const std::vector<double>& energies, double min_energy, int beams,
              const std::vector<bool>& mask = {}) {
    Box box;
    for (std::size_t at = 0; at < energies.size(); ++at) {
        const Eigen::Vector2i bin(static_cast<int>(at) / beams, static_cast<int>(at) % beams);
        if (energies[at] > min_energy && (mask.empty() || mask[at]))
            box.extend(Box(bin, bin + Eigen::Vector2i::Ones()));
    }
    return box;
}

/// The box nearest to `box` that holds `least` and lies within `most`.
Box between(const Box& box, const Box& inner, const Box& outer) {
    return {box.min().cwiseMax(outer.min()).cwiseMin(inner.min()),
            box.max().cwiseMax(inner.max()).cwiseMin(outer.max())};
}

/// The sum of the decibels in a mask that is moved by some beams. All such masks are of one size:
/// those that correlate best cover most decibels.
double decibels_in(const std::vector<int>& bins, int shift, const std::vector<float>& decibels,
                   int beams) {
    double sum = 0.0;
    for (const int bin : bins) {
        const int beam = bin % beams + shift;
        if (beam >= 0 && beam < beams) sum += decibels[bin + shift];
    }
    return sum;
}

}  // namespace

TEST_CASE("cone labels: masks of 500 things lie on their echoes" * doctest::skip(sanitized)) {
    Uniform draw(7);
    std::array<Sonar, spacings.size()> sonars;
    for (const Spacing spacing : spacings)
        sonars[static_cast<std::size_t>(spacing)] = wide_fan(spacing);
    constexpr double noise = 1e-4;  // relative to the brightest bin
    int measured = 0;
    for (int n = 0; n < 500; ++n) {
        CAPTURE(n);
        const Thing thing = draw_thing(draw);
        const Sonar& sonar = sonars[static_cast<std::size_t>(n) % sonars.size()];
        const View& view = sonar.settings.view;
        const Labelled found =
            label(thing.scene, sonar, thing.pose, EngineKind::strips, {.objects = true});
        std::vector<bool> mask;
        std::vector<int> bins;
        for (int i = 0; i < view.range_bins; ++i) {
            for (int j = 0; j < view.beams; ++j) {
                mask.push_back(found.labels.object[found.at(i, j)] > 0);
                if (mask.back()) bins.push_back(i * view.beams + j);
            }
        }
        // A bin within 3 dB of the noise may count or not.
        const std::vector<double> by_points = energies_of_points(found.traced, sonar);
        const double min_energy = noise * *std::ranges::max_element(by_points);
        const Box loud = box_above(by_points, 2.0 * min_energy, view.beams);
        const Box faint = box_above(by_points, 0.5 * min_energy, view.beams);
        if (loud.isEmpty() || loud.sizes().minCoeff() < 20)
            continue;  // a bin more or less tells nothing
        ++measured;
        const std::vector<double> by_labels = energies_of_labels(found.traced, sonar, thing.scene);
        // Both have all of the energy, in another unit.
        const double unit = total(by_labels) / total(by_points);
        const Box box = box_above(by_labels, unit * min_energy, view.beams, mask);
        // One bin and one beam more or less.
        const double min_overlap = (1.0 - 1.0 / loud.sizes().x()) * (1.0 - 1.0 / loud.sizes().y());
        CHECK(overlap(box, between(box, loud, faint)) >= std::min(0.95, min_overlap));
        std::vector<float> decibels = found.clean.intensity;  // above the noise
        const double quiet = noise * *std::ranges::max_element(decibels);
        for (float& value : decibels)
            value = static_cast<float>(10.0 * std::log10(std::max(1.0, value / quiet)));
        const double here = decibels_in(bins, 0, decibels, view.beams);
        for (int shift = 1; shift <= 20; ++shift) {
            CHECK(here >= decibels_in(bins, shift, decibels, view.beams));
            CHECK(here >= decibels_in(bins, -shift, decibels, view.beams));
        }
    }
    CHECK(measured > 450);
}
