#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "command_texts.h"
#include "commands.h"

namespace sonarsim {

namespace {

/// Escapes a text for troff: hyphens that can be copied, and no requests.
std::string troff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
    }
    return out;
}

std::string bold(const std::string& text) {
    return "\\fB" + troff(text) + "\\fR";
}

std::string entry(const OptionText& option) {
    std::string names = option.short_name.empty() ? "" : bold(option.short_name) + ", ";
    names += bold(option.name);
    if (!option.value.empty()) names += " \\fI" + troff(option.value) + "\\fR";
    std::string choices;
    for (const std::string& choice : option.choices)
        choices += (choices.empty() ? "" : ", ") + choice;
    const bool listed =
        choices.empty() || option.meaning.find(option.choices.front()) != std::string::npos;
    return ".TP\n" + names + "\n" + troff(option.meaning) + (listed ? "" : ": " + troff(choices)) +
           "\n";
}

/// The lines of an example, without their heading.
std::string example_lines(const std::string& footer) {
    std::istringstream lines(footer);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  ")) text += troff(line.substr(2)) + "\n";
    }
    return text;
}

std::string section_of(const CommandText& command) {
    std::string text = ".SS \"sonarsim " + troff(command.name);
    for (const OptionText& argument : command.arguments)
        text += " " + troff(argument.name);
    text += command.options.empty() ? "\"\n" : " [options]\"\n";
    text += troff(command.meaning) + ".\n";
    for (const OptionText& argument : command.arguments)
        text += entry(argument);
    for (const OptionText& option : command.options)
        text += entry(option);
    const std::string examples = example_lines(command.examples);
    if (!examples.empty()) text += ".PP\nFor example:\n.PP\n.nf\n.RS\n" + examples + ".RE\n.fi\n";
    return text;
}

std::string manual_page(const CLI::App& app) {
    std::string text = ".TH SONARSIM 1 \"\" \"sonarsim " SONARSIM_VERSION "\" \"User Commands\"\n";
    text += ".SH NAME\nsonarsim \\- simulates sonars, for datasets\n";
    text += ".SH SYNOPSIS\n.B sonarsim\n\\fIcommand\\fR [\\fIoptions\\fR]\n";
    text +=
        ".SH DESCRIPTION\n" + troff(app.get_description()) +
        "\nA mission is a file in YAML; \\fBsonarsim keys\\fR prints every key that it may have.\n"
        ".SH COMMANDS\n";
    for (const CommandText& command : command_texts(app))
        text += section_of(command);
    text +=
        ".SH EXIT STATUS\n"
        ".TP\n0\nDone.\n"
        ".TP\n1\nThe machine could not: disk, memory, processor; or a dataset is not whole.\n"
        ".TP\n2\nThe input or the usage is wrong; the message says where and what is right.\n"
        ".TP\n3\nWith \\fB\\-\\-strict\\fR: there were warnings.\n"
        ".TP\n128 and more\nA signal ended the run: 128 and its number. A dataset goes on where it "
        "stopped.\n";
    text +=
        ".SH FILES\n"
        ".TP\n.I /usr/share/sonarsim\nExample missions, sensors, scenes and scripts of a Debian "
        "package.\n"
        ".TP\n.I /usr/share/doc/sonarsim\nThe documentation.\n";
    return text;
}

}  // namespace

void add_man(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand("man", "Prints the manual page, for man");
    add_examples(command, {"sonarsim man | man -l -"});
    command.callback([&app, &exit_code] {
        fmt::print("{}", manual_page(app));
        exit_code = exit_done;
    });
}

}  // namespace sonarsim
