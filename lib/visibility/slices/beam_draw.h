#pragma once

#include <cstdint>

namespace sonarsim {

/// Draws beams at random, each with a rate of its own.
///
/// The rates are laid end to end on a line. Each unit of the line has one random point, and a beam
/// is drawn as often as points lie on its rate. So the expected number of draws of a beam is its
/// rate, independent of the others. A beam that is drawn n times stands for n / rate beams: a sum
/// over all beams is then estimated without bias (Hansen and Hurwitz 1943). There is one draw per
/// unit, as with strata.
class BeamDraw {
  public:
    /// Draws of different numbers are independent.
    explicit BeamDraw(std::uint32_t number);

    /// The number of beams that the next one stands for; 0 if it is not drawn. A rate is above 0. A
    /// beam with a rate of 1 or more is always drawn, and stands for itself alone.
    double weight(double rate);

  private:
    double next_point() const;

    std::uint32_t number_;
    double rates_ = 0.0;       ///< sum so far
    std::uint32_t units_ = 0;  ///< number of units whose point was passed
    double next_;              ///< the next point on the line
};

}  // namespace sonarsim
