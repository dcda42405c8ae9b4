#include "support/sonars.h"
#include "support/statistics.h"

// The complete noise model on a whole image, against the equations written down as plainly as
// possible: every sample cut into points, each point with the draw of its cell, the standard
// library's distributions, one loop after the other.

namespace {

constexpr double wall_x = 3.0;  // the front wall
constexpr double wall_y = 1.2;  // the port wall
constexpr double R_front = 0.8;
constexpr double R_port = 0.5;

SonarConfig small_sonar() {
    SonarConfig config = small_imaging();
    config.elevation_deg = 6.0;
    set_range(config, 2.0, 4.4, 16);
    config.noise.range_lambda_m = 0.2;
    config.noise.scatterer_m = 0.8;
    config.noise.add_sigma = 0.05;
    config.noise.mult_sigma = 0.1;
    config.multipath.method = MultipathMethod::exact;
    config.streaks.mode = StreakMode::add;
    config.streaks.threshold = 0.3;
    return config;
}

struct PlainPoint {
    std::array<int, 3> cell;
    int beam;
    double range;
    double intensity;
    double weight;
    bool bounced;
    bool normal;
};

class PlainSonar {
  public:
    PlainSonar(const SonarConfig& config, const Samples& samples) : config_(config) {
        constexpr int n = 5;  // points along either edge
        straddles_.assign(config.azimuth_bins, false);
        for (const Sample& s : samples.items) {
            const std::size_t first = points_.size();
            for (int a = 0; a < n; ++a) {
                for (int b = 0; b < n; ++b) {
                    const Eigen::Vector3f at = s.position +
                                               ((2.0F * a + 1.0F) / n - 1.0F) * s.edge_u +
                                               ((2.0F * b + 1.0F) / n - 1.0F) * s.edge_v;
                    add(at.cast<double>(), s.normal.cast<double>(), s.area_m2 / (n * n));
                }
            }
            for (std::size_t k = first; k < points_.size(); ++k) {
                if (points_[k].cell == points_[first].cell) continue;
                for (std::size_t m = first; m < points_.size(); ++m)
                    straddles_[points_[m].beam] = true;
            }
        }
    }

    /// True if a footprint that reaches into the beam lies in several cells. The pipeline draws for
    /// pieces no larger than a cell by their centres; here every point draws for itself.
    bool straddles(int beam) const { return straddles_[beam]; }

    std::vector<double> ping(std::mt19937_64& random) const {
        const int rows = config_.range_bins;
        const int beams = config_.azimuth_bins;
        const double lambda = config_.noise.range_lambda_m;
        std::map<std::pair<bool, std::array<int, 3>>, double> draws;
        std::exponential_distribution<double> exponential(1.0 / lambda);
        std::normal_distribution<double> normal(0.0, 1.0);
        std::vector<double> sum(rows * beams, 0.0), weight(rows * beams, 0.0);
        std::vector<double> area(rows, 0.0), area_normal(rows, 0.0);
        for (const PlainPoint& p : points_) {
            const auto [draw, is_new] = draws.try_emplace({p.bounced, p.cell}, 0.0);
            if (is_new) draw->second = exponential(random);
            const double w = draw->second;
            const double bin = std::floor((p.range + w - config_.range_min_m) / bin_m());  // Eq. 7
            if (!(bin >= 0.0 && bin < rows)) continue;
            const int row = static_cast<int>(bin);
            sum[row * beams + p.beam] += p.weight * p.intensity * std::exp(-w / lambda);  // Eq. 8
            weight[row * beams + p.beam] += p.weight;
            if (p.bounced) continue;
            area[row] += p.weight;
            if (p.normal) area_normal[row] += p.weight;
        }
        std::vector<double> image(rows * beams, 0.0);
        for (int i = 0; i < rows; ++i) {
            const double r = (config_.range_min_m + (i + 0.5) * bin_m()) / config_.range_max_m;
            for (int j = 0; j < beams; ++j) {
                const int k = i * beams + j;
                const double mean = weight[k] > 0.0 ? sum[k] / weight[k] : 0.0;  // Eq. 9
                const double phi = (j + 0.5) / beams - 0.5;  // share of azimuth_deg
                const double lobe = 1.0 + 0.5 * std::exp(-0.5 * phi * phi * 64.0);
                const double x = normal(random);
                const double y = normal(random);
                const double rayleigh =
                    config_.noise.add_sigma * std::sqrt(x * x + y * y);               // Eq. 11
                const double mult = 0.5 + config_.noise.mult_sigma * normal(random);  // Eq. 13
                double value = std::max(0.0, mean * mult + r * r * lobe * rayleigh);  // [10, 12]
                if (area[i] > 0.0 && area_normal[i] >= config_.streaks.threshold * area[i]) {
                    value = std::min(value, 1.0);
                    value = 1.0 - (1.0 - value) * (1.0 - value);  // Eq. 14
                }
                image[k] = value;
            }
        }
        return image;
    }

  private:
    double bin_m() const {
        return (config_.range_max_m - config_.range_min_m) / config_.range_bins;
    }

    /// The beam of a point in the field of view, else -1.
    int beam_at(const Eigen::Vector3d& p) const {
        const double azimuth = std::atan2(p.y(), p.x()) / radians(config_.azimuth_deg) + 0.5;
        const double elevation = std::asin(p.z() / p.norm());
        if (std::fabs(elevation) >= 0.5 * radians(config_.elevation_deg)) return -1;
        if (azimuth < 0.0 || azimuth >= 1.0) return -1;
        return static_cast<int>(azimuth * config_.azimuth_bins);
    }

    void add(const Eigen::Vector3d& at, const Eigen::Vector3d& n, double area) {
        const bool front = std::fabs(n.x()) > 0.5;
        const double R = front ? R_front : R_port;
        const Eigen::Vector3d v = -at.normalized();
        // The offsets of the lattice of cells, in cells.
        const Eigen::Vector3d lattice(0.381966, 0.618034, 0.272019);
        std::array<int, 3> cell;
        for (int k = 0; k < 3; ++k)
            cell[k] = static_cast<int>(std::floor(at[k] / config_.noise.scatterer_m + lattice[k]));
        const int beam = beam_at(at);
        if (beam >= 0) {
            points_.push_back({cell, beam, at.norm(), R * n.dot(v), area, false,
                               n.dot(v) > std::cos(radians(config_.streaks.angle_deg))});
        }
        // To the other wall and back, Eq. 1-3.
        const Eigen::Vector3d r = -v + 2.0 * n.dot(v) * n;
        const double t = front ? (wall_y - at.y()) / r.y() : (wall_x - at.x()) / r.x();
        const Eigen::Vector3d p = at + t * r;
        if (!(t > 0.0) || p.x() < 0.0 || p.x() > wall_x + 1e-9 || p.y() > wall_y + 1e-9) return;
        const Eigen::Vector3d q =
            front ? Eigen::Vector3d(r.x(), -r.y(), r.z()) : Eigen::Vector3d(-r.x(), r.y(), r.z());
        const double cosine = -q.dot(p.normalized());
        if (cosine <= 0.0 || beam_at(p) < 0) return;
        points_.push_back({cell, beam_at(p), 0.5 * (at.norm() + (p - at).norm() + p.norm()),
                           R_front * R_port * cosine, area, true, false});
    }

    SonarConfig config_;
    std::vector<PlainPoint> points_;
    std::vector<bool> straddles_;  ///< indexed by beam
};

}  // namespace

TEST_CASE("a whole noisy image has the distribution of the equations") {
    constexpr int pings = 400;
    Scene scene = rectangle_scene({3, -9, -3}, {3, 1.2F, 3}, R_front);
    add_rectangle(scene, {0, 1.2F, -3}, {3, 1.2F, 3}, add_material(scene, R_port));
    const auto engine = make_rays_engine(scene);
    const SonarConfig config = small_sonar();
    const Sonar sonar = make_sonar(config, {0.01});
    const Samples samples = engine->visible_surface(sonar.settings.view, Pose{});
    const PlainSonar plain(config, samples);
    std::mt19937_64 random(20231);
    const int bins = config.range_bins * config.azimuth_bins;
    std::vector<std::vector<double>> ours(bins), theirs(bins);
    std::uint64_t bounces = 0;
    std::uint64_t streaks = 0;
    for (std::uint32_t k = 0; k < pings; ++k) {
        const Ping ping = render_ping(sonar, scene, *engine, Pose{}, {5, k});
        const std::vector<double> image = plain.ping(random);
        bounces += ping.counts.multipath.bounces;
        streaks += ping.counts.streak_rows;
        for (int i = 0; i < bins; ++i) {
            ours[i].push_back(ping.intensity[i]);
            theirs[i].push_back(image[i]);
        }
    }
    // Every term takes part, and streaks do so in some pings only.
    CHECK(bounces > 100 * pings);
    CHECK(streaks > pings / 2);
    const double level = sidak(bins);
    double worst = 1.0;
    int tested = 0;
    for (int i = 0; i < bins; ++i) {
        if (plain.straddles(i % config.azimuth_bins)) continue;
        worst = std::min(worst, ks_two_samples_p_value(ours[i], theirs[i]));
        ++tested;
    }
    CHECK(2 * tested > bins);
    CHECK(worst > level);
}
