#pragma once

namespace sonarsim {

/// How the program was built, as dataset.json tells it.
struct BuildInfo {
    const char* compiler;  ///< name and version
    const char* flags;     ///< build type and what the user added to the flags
    /// What the values of an image depend on besides the mission and the program's version. Builds
    /// that agree in it make the same values, whatever compiled them.
    const char* arithmetic;
};

BuildInfo build_info();

}  // namespace sonarsim
