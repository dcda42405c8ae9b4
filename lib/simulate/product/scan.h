#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "simulate/ping/sonar.h"

namespace sonarsim {

// A scan is one sweep of a scanning sonar's head: a full turn, or once over its sector. The sector
// is divided into equal steps with a ping in the middle of each.

/// The number of steps, and so of pings, in one sweep: the sector divided by the step, rounded.
int scan_steps(const SonarConfig& config);

/// STEM_NNNN.EXTENSION, the name of a file that belongs to a sweep; `extension` has its dot.
std::string scan_file_name(const std::string& stem, std::size_t sweep,
                           const std::string& extension);

/// The angles of the head, radians, positive to port, from the first ping until they repeat. In a
/// full turn the head keeps turning, from astern over starboard; it sweeps a sector back and forth.
std::vector<double> scan_angles_rad(const SonarConfig& config);

/// The edges of the steps, from starboard (-) to port (+): scan_steps() + 1.
std::vector<double> scan_edges_rad(const SonarConfig& config);

/// The step of the sonar's n-th ping, counted from starboard to port.
int scan_step(const SonarConfig& config, std::size_t ping);

/// A sonar whose beams are the steps of a scan, for drawing a scan as a fan.
Sonar whole_scan(const Sonar& sonar);

/// A display in which each step shows its last ping.
class ScanDisplay {
  public:
    explicit ScanDisplay(const Sonar& sonar);

    /// Shows the n-th ping of the sonar, its range bins from near to far.
    void show(std::size_t ping, std::span<const float> bins);
    /// The display [range, step]; 0 in steps without a ping.
    const Ping& image() const { return image_; }

  private:
    SonarConfig config_;
    Ping image_;
};

/// Calls draw(sweep, begin, end) for each sweep of a sonar, the unfinished one too, with its pings.
template <class Draw>
void for_each_sweep(const SonarConfig& config, std::size_t pings, const Draw& draw) {
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    for (std::size_t begin = 0; begin < pings; begin += steps)
        draw(begin / steps, begin, std::min(begin + steps, pings));
}

}  // namespace sonarsim
