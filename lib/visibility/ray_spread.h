#pragma once

namespace sonarsim {

/// The distance between neighbours in a list of rays. It affects only the time.
enum class RaySpread {
    close,  ///< they take the same path through the scene
    wide    ///< they soon part
};

}  // namespace sonarsim
