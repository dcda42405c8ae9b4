#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/slices/edge_rays.h"
#include "visibility/slices/sampled_image.h"
#include "visibility/view.h"

namespace sonarsim {

/// The image of a view by random rays (visibility/reference_cast.h). It shares nothing with the
/// slices but the scene, so it disagrees where both of their looks err alike.
///
/// A bin's mean echo I is the quotient of two sums over its rays, of w x and of w, where w is the
/// area that a ray represents and x its echo. Its variance is sum w^2 (x - I)^2 / (sum w)^2 for
/// independent rays. Rays that are spread evenly do better by a factor that two independent halves
/// show: their images are apart by sqrt(2 / pi) of a normal deviation on average.
class RayImage {
  public:
    /// Doubles the rays until the sum of the standard deviations over the bins is the share `noise`
    /// of the signal, or up to a fixed number of rays.
    RayImage(const Scene& scene, const Caster& caster, const View& view, const LocalPose& pose,
             double noise);

    /// The relative L1 of another image to this one. The square of a difference less that of two
    /// standard deviations counts, so that noise alone adds a twentieth of itself. Bins that few of
    /// these rays meet are right if other rays found them filled.
    double error_of(const SampledImage& image, std::span<const EdgeBin> edges) const;

    double noise() const { return noise_; }
    std::size_t rays() const { return rays_; }

  private:
    struct Bin {
        double rays = 0.0;
        double area = 0.0;
        double echo = 0.0;
        double area2 = 0.0;        ///< sum w^2
        double area2_echo = 0.0;   ///< sum w^2 x
        double area2_echo2 = 0.0;  ///< sum w^2 x^2

        double mean() const { return rays > 0.0 ? echo / area : 0.0; }
        void add(const Bin& other);
    };

    double deviation(const Bin& bin) const;

    std::vector<Bin> bins_;  ///< [beams, range_bins]
    double signal_ = 0.0;
    double noise_ = 1.0;
    double evenness_ = 1.0;  ///< true standard deviation over that of independent rays
    std::size_t rays_ = 0;
};

}  // namespace sonarsim
