#pragma once

#include <CLI/CLI.hpp>

namespace sonarsim {

/// Lists the commands of the Python package in --help.
void add_python_tools(CLI::App& app);

/// Becomes `python3 -m sonarsim.NAME ...` if the command line names a command of the Python
/// package, with all further options as they are. Returns if it names none. InputError where Python
/// or the package is missing.
void become_python_tool(int argc, char** argv);

}  // namespace sonarsim
