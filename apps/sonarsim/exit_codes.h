#pragma once

namespace sonarsim {

/// The exit codes of the program.
enum ExitCode : int {
    exit_done = 0,
    exit_failed = 1,     ///< disk, memory or processor failed, or a dataset is not whole
    exit_bad_input = 2,  ///< the user's input or usage is wrong
    exit_warned = 3,     ///< with --strict: done, but with warnings
    exit_signal = 128,   ///< plus the number of the signal that ended the run
};

}  // namespace sonarsim
