#pragma once

namespace sonarsim {

/// What the program tells the shell.
enum ExitCode : int {
    exit_done = 0,
    exit_failed = 1,  ///< the machine could not: disk, memory, processor; or a dataset is not whole
    exit_bad_input = 2,  ///< the user's input or usage is wrong
    exit_warned = 3,     ///< with --strict: done, but there was something to warn of
    exit_signal = 128,   ///< plus the number of the signal that ended the run
};

}  // namespace sonarsim
