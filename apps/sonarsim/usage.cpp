#include "usage.h"

#include <vector>

#include "core/text.h"

namespace sonarsim {

namespace {

/// The message for an unknown word on the command line.
std::string unknown(const CLI::App& app, const std::string& word) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    std::vector<std::string> known;
    if (word.starts_with('-')) {
        const CLI::App& command = chosen.empty() ? app : *chosen.front();
        for (const CLI::Option* option : command.get_options()) {
            for (const std::string& name : option->get_lnames())
                known.push_back("--" + name);
        }
        const std::string name = word.substr(0, word.find('='));
        return "unknown option '" + name + "'" + did_you_mean(name, known);
    }
    if (!chosen.empty()) return "one argument too many: '" + word + "'";
    for (const CLI::App* command : app.get_subcommands({}))
        known.push_back(command->get_name());
    return "unknown subcommand '" + word + "'" + did_you_mean(word, known);
}

}  // namespace

std::string usage_message(const CLI::App* app, const CLI::Error& error) {
    const std::vector<std::string> left_over = app->remaining(true);
    const std::string what = left_over.empty() ? error.what() : unknown(*app, left_over.front());
    return "error: " + printable(what) + "\nRun with --help for more information.\n";
}

}  // namespace sonarsim
