#include "simulate/product/soundings.h"

#include "core/elementary.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The bin, with its fraction, at which the echoes of both neighbouring beams are equally strong;
/// empty if none is plain near the run. On oblique ground an echo has many bins, and the middle of
/// the run is as uncertain as their speckle. The echo of one bin comes from nearly one direction,
/// so that the ratio of two beams there has no speckle and is 1 on the axis between them: a
/// regression of its logarithm over the bins (amplitude monopulse). Gains that differ by 1 dB shift
/// it by 0.04 of the beam's footprint: Gaussian beams half a width apart differ by 23 dB over it.
std::optional<double> crossing_of_neighbours(const Ping& ping, int beam,
                                             const DetectedReturn& run) {
    if (beam == 0 || beam + 1 == ping.beams) return {};
    const int around = std::max(run.end - run.begin, 8);  // speckle ends a run early
    const int first = std::max(run.begin - around, 0);
    const int last = std::min(run.end + around, ping.range_bins);
    Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();  // products of 1, the bin, the ratio
    double squares = 0.0;
    for (int i = first; i < last; ++i) {
        const float before = ping.at(i, beam - 1);
        const float after = ping.at(i, beam + 1);
        if (!(before > 0.0F && after > 0.0F)) continue;
        const Eigen::Vector3d terms(1.0, i + 0.5 - first, natural_log(after) - natural_log(before));
        const double weight = ping.at(i, beam);
        sums += weight * terms * terms.transpose();
        squares += weight * weight;
    }
    const double n = sums(0, 0);
    const auto moment = [&](int a, int b) { return n * sums(a, b) - sums(0, a) * sums(0, b); };
    const double covariance = moment(1, 2);
    // Five bins or more decide the line, it explains half of the ratio's variance and crosses 0.
    // Over level ground no line does, but by chance, and then near the run.
    if (n * n < 5.0 * squares) return {};
    if (!(covariance * covariance > 0.5 * moment(1, 1) * moment(2, 2))) return {};
    const double bin = (sums(0, 1) - sums(0, 2) * moment(1, 1) / covariance) / n;
    if (!(bin >= 0.0 && bin < last - first)) return {};
    return first + bin;
}

/// The share of a run in the calibrated model that neither side lobes nor the background explains.
/// `strongest` has the greatest value of all beams in each bin.
double unexplained_share(const Sonar& sonar, const Ping& ping, int beam, const DetectedReturn& run,
                         std::span<const double> values, std::span<const float> strongest) {
    // -25 dB: side lobes of the preset of 400 kHz lie below -30 dB, 99 % of real returns above -17.
    constexpr double side_lobe = 0.003;
    // 6 dB: the volume of water under the TVG, and the best runs of noise, rise by 3 to 9 dB.
    constexpr double background = 4.0;
    double own = 0.0;
    double other = 0.0;
    double above = 0.0;  // the background
    for (int i = run.begin; i < run.end; ++i) {
        own += ping.at(i, beam);
        other += strongest[i];
        above += values[i];
    }
    const double share = std::max(0.0, 1.0 - side_lobe * other / own);
    if (sonar.settings.model->info.mean_noise.empty()) return share;
    return share * std::max(0.0, 1.0 - background * (run.end - run.begin) / above);
}

/// Range and quality of a beam. `values`: divided by its background; `strongest` as above.
Sounding sounding_of_beam(const Sonar& sonar, const Ping& ping, int beam,
                          std::span<const double> values, std::span<const float> strongest) {
    if (std::ranges::none_of(values, [](double value) { return value > 0.0; })) return {};
    DetectedReturn run = detect_return(values);
    if (run.begin == run.end) run = {0, static_cast<int>(values.size()), 1.0, 1.0};  // all alike
    const double rival = run.rival / run.contrast;
    Sounding sounding;
    // An echo may extend beyond the last bin, and then its middle is unknown.
    sounding.quality = run.end < ping.range_bins ? std::max(0.0, 1.0 - rival * rival) : 0.0;
    sounding.range_m = 0.5 * (sonar.range_edges_m[run.begin] + sonar.range_edges_m[run.end]);
    if (sonar.config.model == ModelKind::calibrated) {
        sounding.quality *= unexplained_share(sonar, ping, beam, run, values, strongest);
        if (const auto at = crossing_of_neighbours(ping, beam, run)) {
            const auto bin = static_cast<std::size_t>(*at);
            sounding.range_m = std::lerp(sonar.range_edges_m[bin], sonar.range_edges_m[bin + 1],
                                         *at - static_cast<double>(bin));
        }
    }
    return sounding;
}

/// Divides a beam by its background. This is the mean noise of the receiver, which the TVG raises
/// with range, plus what the median bin has above it, such as water or side lobes. Undivided, noise
/// at long range may be stronger than the bottom. Divided by the noise alone, near water may be.
void divide_by_background(std::span<double> beam, std::span<const float> noise) {
    constexpr double median_share = 0.693;  // ln 2: median / mean of an exponential number
    constexpr double min_power = 1e-30;
    std::vector<double> excess(beam.size());
    for (std::size_t i = 0; i < beam.size(); ++i)
        excess[i] = beam[i] - median_share * noise[i];
    const auto middle = excess.begin() + static_cast<std::ptrdiff_t>(excess.size() / 2);
    std::nth_element(excess.begin(), middle, excess.end());
    const double constant = std::max(*middle, min_power);
    for (std::size_t i = 0; i < beam.size(); ++i)
        beam[i] /= constant + noise[i];
}

class Contrast {
  public:
    explicit Contrast(std::span<const double> beam) : sums_(beam.size() + 1) {
        double sum = 0.0;
        for (const double value : beam)
            sum += value;
        const double mean = sum / static_cast<double>(beam.size());
        for (std::size_t i = 0; i < beam.size(); ++i)
            sums_[i + 1] = sums_[i] + (beam[i] - mean);
    }

    int bins() const { return static_cast<int>(sums_.size()) - 1; }

    /// The contrast of the run [begin, end); 0 if it is not within the beam.
    double of(int begin, int end) const {
        if (begin < 0 || end > bins() || begin >= end) return 0.0;
        return (sums_[end] - sums_[begin]) / std::sqrt(static_cast<double>(end - begin));
    }

    /// The best of half-overlapping runs of 1, 2, 4, ... bins within [from, to).
    DetectedReturn coarse(int from, int to) const {
        DetectedReturn best;
        for (int length = 1; from + length <= to; length *= 2) {
            const int step = std::max(length / 2, 1);
            double max_sum = 0.0;
            int at = from;
            for (int begin = from; begin + length <= to; begin += step) {
                const double sum = sums_[begin + length] - sums_[begin];
                if (sum > max_sum) {
                    max_sum = sum;
                    at = begin;
                }
            }
            const double contrast = max_sum / std::sqrt(static_cast<double>(length));
            if (contrast > best.contrast) best = {at, at + length, contrast, 0.0};
        }
        return best;
    }

  private:
    std::vector<double> sums_;
};

/// Moves the ends of a run while its contrast grows, first by half of its length, then by less.
void refine(const Contrast& contrast, DetectedReturn& run) {
    for (int step = std::max((run.end - run.begin) / 2, 1); step >= 1; step /= 2) {
        for (bool moved = true; moved;) {
            moved = false;
            for (const auto& [begin, end] :
                 {std::pair(-step, 0), {step, 0}, {0, -step}, {0, step}}) {
                const double gained = contrast.of(run.begin + begin, run.end + end);
                if (gained <= run.contrast) continue;
                run = {run.begin + begin, run.end + end, gained, 0.0};
                moved = true;
            }
        }
    }
}

}  // namespace

int beams_with_sounding(const Ping& ping) {
    std::vector<char> occupied(ping.beams);
    for (int i = 0; i < ping.range_bins; ++i) {
        for (int j = 0; j < ping.beams; ++j)
            occupied[j] |= ping.at(i, j) > 0.0F ? 1 : 0;
    }
    return static_cast<int>(std::ranges::count(occupied, 1));
}

std::vector<Sounding> find_soundings(const Sonar& sonar, const Pose& T_world_vehicle,
                                     const Ping& ping, const PingMotion& motion) {
    const Pose T_world_sensor = T_world_vehicle * sonar.T_vehicle_sensor;
    const TruePlaces places{T_world_sensor, sonar.sound_profile.get(), motion,
                            sonar.settings.view.shape};
    const std::span<const float> growth = sonar.settings.model->info.noise_growth;
    const std::span<const float> noise = sonar.settings.model->info.mean_noise;
    std::vector<Sounding> soundings(ping.beams);
    std::vector<float> strongest;
    for (auto row = ping.intensity.begin(); row != ping.intensity.end(); row += ping.beams)
        strongest.push_back(*std::max_element(row, row + ping.beams));
    std::vector<double> beam(ping.range_bins);
    for (int j = 0; j < ping.beams; ++j) {
        for (int i = 0; i < ping.range_bins; ++i)
            beam[i] = static_cast<double>(ping.at(i, j)) / (growth.empty() ? 1.0F : growth[i]);
        if (!noise.empty()) divide_by_background(beam, noise);
        soundings[j] = sounding_of_beam(sonar, ping, j, beam, strongest);
        if (std::isnan(soundings[j].range_m)) continue;
        soundings[j].position =
            places.of(soundings[j].range_m * direction_of(sonar.beam_azimuths_rad[j], 0.0));
    }
    return soundings;
}

DetectedReturn detect_return(std::span<const double> beam) {
    if (beam.empty()) return {};
    const Contrast contrast(beam);
    DetectedReturn run = contrast.coarse(0, contrast.bins());
    if (run.begin == run.end) return run;
    refine(contrast, run);
    // Close runs belong to the same surface, as its faint end or behind a gap in its speckle.
    const int apart = (run.end - run.begin) / 2 + 2;
    run.rival = std::max(contrast.coarse(0, run.begin - apart).contrast,
                         contrast.coarse(run.end + apart, contrast.bins()).contrast);
    return run;
}

float farthest_surface_m(const TracedPing& traced) {
    float farthest_m = 0.0F;
    for_each_received(traced, [&](const Sample& sample) {
        farthest_m = std::max(farthest_m, arrival_range(sample.position) + sample.edge_u.norm() +
                                              sample.edge_v.norm());
    });
    return farthest_m;
}

std::optional<int> first_return(std::span<const float> column) {
    const int bins = static_cast<int>(column.size());
    const auto at = [&](int i) { return i < 0 || i >= bins ? 0.0F : column[i]; };
    std::vector<float> mean(column.size());
    for (int i = 0; i < bins; ++i)
        mean[i] = (at(i - 1) + at(i) + at(i + 1)) / 3.0F;
    const float half = column.empty() ? 0.0F : 0.5F * std::ranges::max(mean);
    if (!(half > 0.0F)) return std::nullopt;
    const auto first = std::ranges::find_if(mean, [&](float value) { return value >= half; });
    // The running mean rises one bin before the edge of a short echo.
    int edge = std::max(static_cast<int>(first - mean.begin()) - 1, 0);
    while (edge + 1 < bins && at(edge) < half)
        ++edge;
    return edge;
}

}  // namespace sonarsim
