#pragma once

#include <span>
#include <vector>

#include "visibility/slices/scan.h"
#include "visibility/view.h"

namespace sonarsim {

/// The image of a beam; bins without a value are dark.
struct BeamImage {
    int first;  ///< bin of the first value
    std::span<const float> intensities;

    int end() const { return first + static_cast<int>(intensities.size()); }
    float at(int bin) const {
        return first <= bin && bin < end() ? intensities[bin - first] : 0.0F;
    }
};

/// The difference d of two images of a beam.
struct BeamDistance {
    double absolute = 0.0;  ///< the sum over the bins of |d|
    double squares = 0.0;   ///< the sum of d^2
    /// The sum of the squared sums over runs of bins in which d has one sign.
    double runs = 0.0;
};

BeamDistance distance(const BeamImage& a, const BeamImage& b);

/// Surface of one beam by range bin: area, and area times intensity. Their quotient is the image.
class BeamSums {
  public:
    explicit BeamSums(const View& view);

    /// Adds surface that is spread evenly over an interval of range. Its intensity follows from
    /// `reflection` and the sensor's distance from its plane.
    void add(const Interval& range_m, float area_m2, float height_m, float reflection);

    /// Adds the sums of other surface in the same beam.
    void add(const BeamSums& other);

    void clear();

    /// Appends the intensities of the bins from first() to last() to `out`.
    void append_intensities(std::vector<float>& out) const;

    int count() const { return count_; }
    /// Bins outside of [first, last] are dark.
    int first() const { return first_; }
    int last() const { return last_; }
    /// Bins from -1 to `padding` beyond the last may be read; those outside of the view are dark.
    float area(int i) const { return area_[i + 1]; }
    float echo(int i) const { return echo_[i + 1]; }
    float intensity(int i) const { return area(i) > 0.0F ? echo(i) / area(i) : 0.0F; }
    static constexpr int padding = 8;

    /// Bins whose border the surface of a neighbouring bin touches. Unsorted, with repetitions.
    std::vector<int>& touched() { return touched_; }

  private:
    float per_m_;     ///< bins per metre
    float min_bins_;  ///< the least range, in bins
    int count_;
    int first_;
    int last_ = -1;
    std::vector<float> area_;  ///< bin i is at i + 1
    std::vector<float> echo_;
    std::vector<int> touched_;
};

}  // namespace sonarsim
