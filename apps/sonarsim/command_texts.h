#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sonarsim {

/// An option or an argument of a command, as --help tells it.
struct OptionText {
    std::string name;        ///< "--threads", or that of an argument
    std::string short_name;  ///< "-j"; "" where there is none
    std::string value;       ///< what follows it, "N"; "" for a flag
    std::vector<std::string> choices;
    std::string meaning;
};

struct CommandText {
    std::string name;
    std::string meaning;
    std::vector<OptionText> arguments;
    std::vector<OptionText> options;
    std::string examples;  ///< a line each
};

/// All that --help knows of the commands: the manual page and the completions are made of it.
std::vector<CommandText> command_texts(const CLI::App& app);

/// Gives each command and the program itself the examples that --help ends with.
void add_examples(CLI::App& app);

}  // namespace sonarsim
