#pragma once

#include <vector>

#include "core/lanes.h"

namespace sonarsim {

/// One number of each of the transforms that are made at a time.
using Lanes = std::array<float, lanes>;

struct alignas(32) ComplexLanes {
    Lanes re, im;
};

/// Fourier transforms, X[k] = sum x[n] e^(-2 pi i k n / N); N is 1, 3 or 5 times a power of two.
class Fourier {
  public:
    /// `size`: such an N from 2 on.
    explicit Fourier(int size);

    int size() const { return size_; }

    /// Transforms `data` [size] in place; `scratch` [size] is overwritten.
    void forward(ComplexLanes* data, ComplexLanes* scratch) const;
    /// The inverse, without the factor 1 / N.
    void backward(ComplexLanes* data, ComplexLanes* scratch) const;

  private:
    struct Root {
        float re, im;
    };
    template <bool inverse, int radix>
    void odd_step(const ComplexLanes* from, ComplexLanes* to) const;
    template <bool inverse>
    void transform(ComplexLanes* data, ComplexLanes* scratch) const;

    int size_;
    std::vector<Root> roots_;  ///< e^(-2 pi i k / N)
};

/// The smallest size of a transform that is at least `count` and at least 2.
int transform_size(int count);

}  // namespace sonarsim
