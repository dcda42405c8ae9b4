#include "command_texts.h"

#include <sstream>

#include "commands.h"

namespace sonarsim {

namespace {

/// CLI11 writes the choices as "{this,that}" after the type.
std::vector<std::string> choices_in(const std::string& type) {
    const std::size_t begin = type.find('{');
    const std::size_t end = type.find('}');
    std::vector<std::string> choices;
    if (begin == std::string::npos || end == std::string::npos) return choices;
    std::istringstream list(type.substr(begin + 1, end - begin - 1));
    for (std::string one; std::getline(list, one, ',');)
        choices.push_back(one);
    return choices;
}

OptionText text_of(const CLI::Option& option) {
    OptionText text{.name = option.get_positional() ? option.get_name(true) : "",
                    .short_name = "",
                    .value = "",
                    .choices = {},
                    .meaning = option.get_description()};
    if (!option.get_lnames().empty()) text.name = "--" + option.get_lnames().front();
    if (!option.get_snames().empty()) text.short_name = "-" + option.get_snames().front();
    if (option.get_type_size() == 0) return text;
    const std::string type = option.get_type_name();
    text.choices = choices_in(type);
    if (!option.get_positional()) text.value = type.substr(0, type.find(':'));
    return text;
}

}  // namespace

void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
    std::string text = "Examples:";
    for (const char* line : lines)
        text += std::string("\n  ") + line;
    command.footer(text);
}

std::vector<CommandText> command_texts(const CLI::App& app) {
    std::vector<CommandText> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        CommandText& text = commands.emplace_back();
        text.name = command->get_name();
        text.meaning = command->get_description();
        text.examples = command->get_footer();
        for (const CLI::Option* option : command->get_options()) {
            const bool argument = option->get_positional();
            (argument ? text.arguments : text.options).push_back(text_of(*option));
        }
    }
    return commands;
}

}  // namespace sonarsim
