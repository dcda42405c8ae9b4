#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>

#include "exit_codes.h"

namespace sonarsim {

/// Adds examples at the end of --help.
void add_examples(CLI::App& command, std::initializer_list<const char*> lines);

// Each function adds one subcommand, which stores its exit code in `exit_code` and may throw.

void add_render(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_preview(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_inspect(CLI::App& app, int& exit_code);
void add_materials(CLI::App& app, int& exit_code);
void add_preset(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_keys(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_warnings(CLI::App& app, int& exit_code);
void add_import_holoocean(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_man(CLI::App& app, int& exit_code);

}  // namespace sonarsim
