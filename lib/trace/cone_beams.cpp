#include "trace/cone_beams.h"

#include <algorithm>

namespace sonarsim {

ConeBeams::ConeBeams(std::span<const double> edge_sines)
    : edges_(edge_sines.begin(), edge_sines.end()) {
    if (edges_.empty()) return;
    // Rounding may put a sine into the next step, so the search begins one step earlier.
    const int steps = 4 * static_cast<int>(edges_.size());
    const float span = edges_.back() - edges_.front();
    steps_per_unit_ = static_cast<float>(steps) / span;
    int beam = 0;
    for (int k = 0; k <= steps; ++k) {
        const float sine =
            edges_.front() + span * static_cast<float>(k - 1) / static_cast<float>(steps);
        while (beam + 2 < static_cast<int>(edges_.size()) && sine >= edges_[beam + 1])
            ++beam;
        first_.push_back(beam);
    }
}

int ConeBeams::beam(float sine) const {
    if (!(sine >= edges_.front() && sine < edges_.back())) return -1;
    const auto step = static_cast<std::size_t>((sine - edges_.front()) * steps_per_unit_);
    int beam = first_[std::min(step, first_.size() - 1)];
    while (sine >= edges_[beam + 1])
        ++beam;
    return beam;
}

}  // namespace sonarsim
