#include "simulate/product/detect_return.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sonarsim {

namespace {

/// Cumulative sums of a beam about its mean.
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

    /// The run of the greatest contrast among half-overlapping runs of 1, 2, 4, ... bins within
    /// [from, to).
    DetectedReturn coarse(int from, int to) const {
        DetectedReturn best;
        for (int length = 1; from + length <= to; length *= 2) {
            const int step = std::max(length / 2, 1);
            double most = 0.0;
            int at = from;
            for (int begin = from; begin + length <= to; begin += step) {
                const double sum = sums_[begin + length] - sums_[begin];
                if (sum > most) {
                    most = sum;
                    at = begin;
                }
            }
            const double contrast = most / std::sqrt(static_cast<double>(length));
            if (contrast > best.contrast) best = {at, at + length, contrast, 0.0};
        }
        return best;
    }

  private:
    std::vector<double> sums_;
};

/// Moves the ends of a run as long as its contrast grows, first by half of its length, then by
/// less.
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

}  // namespace sonarsim
