#pragma once

namespace sonarsim {

/// Build information, as written to dataset.json.
struct BuildInfo {
    const char* version;
    const char* compiler;  ///< name and version
    const char* flags;     ///< build type and the user's additional flags
    /// Instruction set of the arithmetic. Two builds with the same one give the same image values
    /// for a mission and a program version, whatever compiler built them.
    const char* arithmetic;
};

BuildInfo build_info();

}  // namespace sonarsim
