// The example of docs/development.md, "Add a label".

#include "support/sonars.h"

namespace {

/// Finds the mean cosine of the angle of incidence of a beam's bins, weighted by the echo.
class IncidenceFinder {
  public:
    IncidenceFinder(const RangeBins& bins, int beams) : sums_(bins, beams) {}

    /// Takes the echoes of EchoModel::surface_echoes().
    void add(EchoBlock echoes) {
        if (echoes.multipath) return;
        std::array<std::uint32_t, EchoBlock::capacity> sources{};
        sums_.add(echoes, sources);
        // v . n of a plane is the sonar's height above it over the range.
        for (int k = 0; k < echoes.count; ++k)
            echoes.intensity[k] *= echoes.sample[k]->height_m / echoes.range_m[k];
        sources.fill(1);
        sums_.add(echoes, sources);
    }

    /// `cosine` by range bin; 0: no surface.
    void find(int beam, std::span<float> cosine) const {
        std::vector<float> echo(cosine.size());
        std::ranges::fill(cosine, 0.0F);
        sums_.add_to(0, beam, echo);
        sums_.add_to(1, beam, cosine);
        for (std::size_t i = 0; i < cosine.size(); ++i) {
            if (echo[i] > 0.0F) cosine[i] /= echo[i];
        }
    }

  private:
    EchoSums sums_;
};

}  // namespace

/// The cosine is H / r on a level floor at the depth H, the area of a sector of it grows with r dr,
/// and its echo with (H / r) r dr. The mean over a bin from r to s is H ln(s / r) / (s - r), which
/// is H / r_mid up to ((s - r) / r_mid)^2 / 12.
TEST_CASE("example of a label: the incidence on a level floor") {
    constexpr double depth_m = 2.0;
    Scene scene = floor_scene(30.0F, -depth_m, 0.3F);
    const Sonar sonar = make_sonar(small_imaging(), {.relative_l1 = 0.01});
    const auto engine = make_engine(scene, {});
    const Pose tilted = pitched(degrees(0.5));
    const TracedPing traced = trace(sonar, scene, *engine, tilted, 0);

    const View& view = sonar.settings.view;
    IncidenceFinder finder(range_bins(view), view.beams);
    sonar.settings.model->surface_echoes(traced, view, scene, {},
                                         [&](const EchoBlock& echoes) { finder.add(echoes); });
    std::vector<float> cosine(view.range_bins);
    finder.find(view.beams / 2, cosine);
    int bins = 0;
    for (int i = 1; i + 1 < view.range_bins; ++i) {
        if (cosine[i - 1] == 0.0F || cosine[i] == 0.0F || cosine[i + 1] == 0.0F) continue;
        CHECK(cosine[i] == approx(depth_m / bin_centre(sonar, i)).epsilon(0.005));
        ++bins;
    }
    CHECK(bins > 30);
}
