// The example of docs/add_a_label.md.
#include <doctest/doctest.h>

#include <cmath>

#include "paper/accumulate.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "visibility/make_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Finds the mean cosine of the angle of incidence of a beam's bins, weighted by area.
class IncidenceFinder {
  public:
    IncidenceFinder(std::size_t materials, const RangeBins& bins)
        : mirrors_(materials), bins_(bins) {
        for (Material& material : mirrors_)
            material.reflection = 1.0F;
    }

    /// `cosine` by range bin; 0: no surface.
    void find(std::span<const Sample> samples, std::span<float> cosine) {
        // With a reflection of 1 the intensity of an echo is v . n, Eq. 6.
        direct_echoes(samples, mirrors_, bins_.bin_m, ScattererLattice{}, echoes_);
        sums_.clear(bins_.count);
        accumulate(echoes_, bins_, sums_);
        mean_of_bins(sums_, cosine);
    }

  private:
    std::vector<Material> mirrors_;
    RangeBins bins_;
    Echoes echoes_;
    BinSums sums_;
};

}  // namespace

/// The cosine is H / r on a level floor at the depth H, and the area of a sector of it grows with
/// r dr. The mean over a bin is int (H / r) r dr / int r dr = H / r_mid.
TEST_CASE("example of a label: the incidence on a level floor") {
    constexpr double depth_m = 2.0;
    Scene scene = empty_scene();
    add_floor(scene, 30.0F, -depth_m, add_material(scene, 0.3F));
    const Sonar sonar = make_sonar(small_imaging(), {.relative_l1 = 0.01});
    const auto engine = make_engine(scene, {});
    const Pose tilted{rotation_from_rpy(0.0, 0.5, 0.0), Eigen::Vector3d::Zero()};
    const TracedPing traced = trace(sonar, scene, *engine, tilted, 0);

    const View& view = sonar.settings.view;
    IncidenceFinder finder(scene.materials.size(), range_bins(view));
    std::vector<float> cosine(view.range_bins);
    finder.find(traced.samples.beam(view.beams / 2), cosine);
    int bins = 0;
    for (int i = 1; i + 1 < view.range_bins; ++i) {
        if (cosine[i - 1] == 0.0F || cosine[i] == 0.0F || cosine[i + 1] == 0.0F) continue;
        const double middle_m = 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
        CHECK(cosine[i] == doctest::Approx(depth_m / middle_m).epsilon(0.005));
        ++bins;
    }
    CHECK(bins > 30);
}
