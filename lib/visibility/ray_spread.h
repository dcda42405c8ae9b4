#pragma once

namespace sonarsim {

/// The distance between neighbours in a list of rays. It decides on the time alone.
enum class RaySpread {
    close,  ///< they take the same way through the scene
    wide    ///< they soon part
};

}  // namespace sonarsim
