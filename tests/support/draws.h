#pragma once

#include "core/random.h"
#include "support/test.h"

namespace sonarsim::test {

/// The draws of one scene, in order.
class Draws {
  public:
    explicit Draws(std::uint32_t number) : number_(number) {}

    float between(float low, float high) { return low + (high - low) * unit_float(word()); }
    /// Evenly in the logarithm.
    float scale(float low, float high) {
        return low * static_cast<float>(power(static_cast<double>(high / low)));
    }
    int whole(int low, int high) {
        return low + static_cast<int>(word() % static_cast<std::uint32_t>(high - low + 1));
    }
    bool half() { return (word() & 0x100U) != 0; }
    Eigen::Vector3f in_ball() {
        while (true) {
            // One by one: the order of arguments differs between compilers.
            const float z = between(-1, 1);
            const float y = between(-1, 1);
            const float x = between(-1, 1);
            const Eigen::Vector3f p(x, y, z);
            if (p.squaredNorm() <= 1.0F) return p;
        }
    }

  private:
    std::uint32_t word() { return philox({count_++, number_, 0, 0}, {0x6c617474U, 0}).x0; }
    double power(double base) { return std::pow(base, static_cast<double>(unit_float(word()))); }

    std::uint32_t number_;
    std::uint32_t count_ = 0;
};

/// Uniform numbers; std::uniform_real_distribution differs between libraries.
class Uniform {
  public:
    explicit Uniform(std::uint32_t seed) : bits_(seed) {}

    double between(double low, double high) {
        return low + (high - low) * (bits_() / 4294967296.0);
    }
    float single(double low, double high) { return static_cast<float>(between(low, high)); }

  private:
    std::mt19937 bits_;
};

}  // namespace sonarsim::test
