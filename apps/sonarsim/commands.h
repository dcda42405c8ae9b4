#pragma once

#include <CLI/CLI.hpp>

namespace sonarsim {

/// What the program tells the shell.
enum ExitCode : int {
    exit_done = 0,
    exit_failed = 1,     ///< the machine could not: disk, memory
    exit_bad_input = 2,  ///< the user's input or usage is wrong
    exit_signal = 128,   ///< plus the number of the signal that ended the run
};

// Each adds one subcommand. What it runs leaves its exit code in `exit_code` and may throw.

void add_render(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_inspect(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_keys(CLI::App& app, int& exit_code);

}  // namespace sonarsim
