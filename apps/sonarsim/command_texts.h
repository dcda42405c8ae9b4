#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sonarsim {

/// An option or an argument of a command, as in --help.
struct OptionText {
    std::string name;        ///< "--threads", or the name of an argument
    std::string short_name;  ///< "-j"; "": none
    std::string value;       ///< name of its value, "N"; "" for a flag
    std::vector<std::string> choices;
    std::string meaning;
};

struct CommandText {
    std::string name;
    std::string meaning;
    std::vector<OptionText> arguments;
    std::vector<OptionText> options;
    std::string examples;  ///< one line each
};

/// The commands as in --help, for the manual page and the completions.
std::vector<CommandText> command_texts(const CLI::App& app);

}  // namespace sonarsim
