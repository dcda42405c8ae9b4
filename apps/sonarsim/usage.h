#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sonarsim {

/// What is wrong with a command line that `app` refused, and how to get help: subcommands and
/// options that do not exist are named, with the nearest that do. For CLI::App::failure_message.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace sonarsim
