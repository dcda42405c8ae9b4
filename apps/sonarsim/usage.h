#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sonarsim {

/// The message for a command line that `app` refused: the error, unknown subcommands and options
/// with the nearest known ones, and how to get help. For CLI::App::failure_message.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace sonarsim
