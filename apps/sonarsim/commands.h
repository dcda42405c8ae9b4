#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "exit_codes.h"
#include "logging.h"

namespace sonarsim {

/// Adds examples at the end of --help.
inline void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
    std::string text = "Examples:";
    for (const char* line : lines)
        text += std::string("\n  ") + line;
    command.footer(text);
}

/// Adds a subcommand to a group of --help, with the arguments of `run`, which live as long as it.
/// Its callback starts the log, if it has options of it, and stores the exit code of `run`.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, int& exit_code, const char* name,
                                             const char* meaning, const char* group,
                                             std::initializer_list<const char*> examples,
                                             int (*run)(const Arguments&)) {
    CLI::App& command = *app.add_subcommand(name, meaning)->group(group);
    add_examples(command, examples);
    const auto arguments = std::make_shared<Arguments>();
    command.callback([arguments, run, &exit_code] {
        if constexpr (requires { arguments->log; }) start_logging(arguments->log);
        exit_code = run(*arguments);
    });
    return {command, *arguments};
}

// Each function adds one subcommand, which stores its exit code in `exit_code` and may throw.

void add_new(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_preview(CLI::App& app, int& exit_code);
void add_inspect(CLI::App& app, int& exit_code);
void add_preset(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_keys(CLI::App& app, int& exit_code);
void add_warnings(CLI::App& app, int& exit_code);

/// Lists the commands of the Python package in --help.
void add_python_tools(CLI::App& app);

/// Becomes `python3 -m sonarsim.NAME ...`, with all further options, if the command line names a
/// command of the Python package. InputError where Python or the package is missing.
void become_python_tool(int argc, char** argv);

/// The first Ctrl-C (SIGINT) or SIGTERM sets the returned flag. If the program has not ended a
/// second later, as in a long ping, it writes `last_words` to stderr and exits with code 128 plus
/// the signal's number. A second signal ends the program at once.
std::atomic<bool>& stop_on_signal(std::string_view last_words);

/// The exit code of a command that a signal has stopped.
int exit_code_of_signal();

}  // namespace sonarsim
