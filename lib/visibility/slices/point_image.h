#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/slices/bin_pieces.h"
#include "visibility/slices/edge_rays.h"
#include "visibility/slices/sampled_image.h"
#include "visibility/view.h"

namespace sonarsim {

/// The image of a view by rays to random points of the surface. It shares only the mesh with the
/// slices, so it shows errors that the slices and their check have in common. Points are drawn bin
/// by bin, so a sliver of surface, which makes a bin as bright as a wall does, gets as many points
/// as a wall.
///
/// A bin's mean echo I is the quotient of two sums over its visible points, of w x and of w, where
/// w is the area that a point represents and x its echo. Its variance is sum w^2 (x - I)^2 /
/// (sum w)^2 for independent points. The points of a bin are spread evenly over its area, which
/// makes the true variance smaller.
class PointImage {
  public:
    /// Draws points until the sum of the standard deviations over the bins is a quarter of the
    /// view's error goal, or up to a fixed number. Each draw adds points where they lower the sum
    /// most. The image stays empty if the surface has too many pieces (bin_pieces()).
    PointImage(const Scene& scene, const ClusterMesh& mesh, const Caster& caster, const View& view,
               const LocalPose& pose);

    /// The relative L1 of another image to this one. The square of a difference less the variance
    /// of this image is unbiased.
    double error_of(const SampledImage& image, std::span<const EdgeBin> edges) const;

  private:
    struct Bin {
        double area_per_point = 0.0;  ///< 0 if the bin has no surface
        double points = 0.0;          ///< visible ones
        double area = 0.0;
        double echo = 0.0;
        double area2 = 0.0;        ///< sum w^2
        double area2_echo = 0.0;   ///< sum w^2 x
        double area2_echo2 = 0.0;  ///< sum w^2 x^2

        double mean() const { return points > 0.0 ? echo / area : 0.0; }
        double deviation() const;
    };

    /// A visible point.
    struct Seen {
        std::uint32_t drawn_in;  ///< index into BinPieces::bins
        std::uint32_t bin;       ///< [beams, range_bins] index
        float echo;
    };

    /// Computes bins and signal, and returns the sum of the standard deviations; `drawn` has the
    /// number of points of each of the pieces' bins.
    double sum_up(const BinPieces& pieces, std::span<const std::uint32_t> drawn,
                  std::span<const Seen> seen);

    /// The number of points of each of the pieces' bins for `all` in sum. The sum of s_k /
    /// sqrt(n_k) for a given sum of the n_k is least with n_k in proportion to s_k^(2/3), where s_k
    /// is the standard deviation of one point.
    std::vector<std::uint32_t> target_counts(const BinPieces& pieces,
                                             std::span<const std::uint32_t> drawn,
                                             double all) const;

    /// True if no point met a bin in which `image` has surface, and yet the surface may be there.
    bool may_be_missed(std::size_t k, const SampledImage& image, EdgeBin edge) const;

    std::vector<Bin> bins_;  ///< [beams, range_bins]
    double signal_ = 0.0;
};

}  // namespace sonarsim
