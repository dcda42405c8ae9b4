#pragma once

namespace sonarsim {

/// The distance between neighbours in a list of rays. It affects only the time.
enum class RaySpread {
    close,  ///< neighbours take similar paths through the scene
    wide    ///< neighbours soon diverge
};

}  // namespace sonarsim
