#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ping/sonar.h"

namespace sonarsim {

// A scan is what the head of a scanning sonar passes in one sweep: all the way round, or once over
// its sector. The sector is cut into equal steps, and there is a ping in the middle of each.

/// Steps, and so pings, of one sweep: the sector divided by the step, rounded.
int scan_steps(const SonarConfig& config);

/// Sweeps that this many pings make, the unfinished one at the end included.
std::size_t scan_sweeps(const SonarConfig& config, std::size_t pings);

/// STEM_NNNN.EXTENSION, the name of a file that belongs to a sweep; `extension` has its dot.
std::string scan_file_name(const std::string& stem, std::size_t sweep,
                           const std::string& extension);

/// The angles of the head, radians, positive to port, from the first ping until they repeat. A full
/// turn goes round and round from behind over starboard; a sector is swept to and fro.
std::vector<double> scan_angles_rad(const SonarConfig& config);

/// The edges of the steps, from starboard (-) to port (+): scan_steps() + 1.
std::vector<double> scan_edges_rad(const SonarConfig& config);

/// The step, from starboard to port, that the n-th ping of the sonar falls on.
int scan_step(const SonarConfig& config, std::size_t ping);

/// A sonar whose beams are the steps of a scan, for what draws a scan as a fan.
Sonar whole_scan(const Sonar& sonar);

/// A display: each step shows the last ping that fell on it.
class ScanDisplay {
  public:
    explicit ScanDisplay(const Sonar& sonar);

    /// Shows the n-th ping of the sonar, its range bins from near to far.
    void show(std::size_t ping, std::span<const float> bins);
    /// [range, step], 0 where no ping has been.
    const Ping& image() const { return image_; }

  private:
    SonarConfig config_;
    Ping image_;
};

}  // namespace sonarsim
