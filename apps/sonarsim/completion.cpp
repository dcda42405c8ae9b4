#include <spdlog/fmt/fmt.h>

#include <map>
#include <memory>
#include <string>

#include "command_texts.h"
#include "commands.h"

namespace sonarsim {

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos;
         at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// Quotes a text for bash and zsh.
std::string single_quoted(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string names_of_options(const CommandText& command) {
    std::vector<std::string> names;
    for (const OptionText& option : command.options)
        names.push_back(option.name);
    return joined(names);
}

std::string bash(const std::vector<CommandText>& commands) {
    std::vector<std::string> names;
    std::string options;
    std::string choices;
    for (const CommandText& command : commands) {
        names.push_back(command.name);
        options += "        " + command.name + ") options='" + names_of_options(command) + "' ;;\n";
        for (const OptionText& option : command.options) {
            if (option.choices.empty()) continue;
            choices += "        '" + command.name + " " + option.name + "') words='" +
                       joined(option.choices) + "' ;;\n";
        }
        for (const OptionText& argument : command.arguments) {
            if (argument.choices.empty()) continue;
            choices += "        '" + command.name + " " + command.name + "') words='" +
                       joined(argument.choices) + "' ;;\n";
        }
    }
    return "# Completion of sonarsim for bash.\n"
           "_sonarsim() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
           "    local command='' word options='' words=''\n"
           "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
           "        [[ $word == -* ]] || { command=$word; break; }\n"
           "    done\n"
           "    case $command in\n"
           "        '') words='" +
           joined(names) + " --help --version' ;;\n" + options +
           "    esac\n"
           "    case \"$command $before\" in\n" +
           choices +
           "    esac\n"
           "    [[ -z $words && $current == -* ]] && words=$options\n"
           "    if [[ -n $words ]]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
           "    else\n"
           "        compopt -o filenames 2>/dev/null\n"
           "        mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
           "    fi\n"
           "}\n"
           "complete -F _sonarsim sonarsim\n";
}

/// The completion of an option's value for zsh: choices, or files.
std::string zsh_value(const OptionText& option) {
    // A positional argument has no value name, and an empty message has another meaning in zsh.
    const std::string& message = option.value.empty() ? option.name : option.value;
    if (!option.choices.empty()) return ":" + message + ":(" + joined(option.choices) + ")";
    return ":" + option.value + ":_files";
}

std::string zsh(const std::vector<CommandText>& commands) {
    const auto meaning = [](std::string text) {
        for (const char* special : {"[", "]", ":"})
            text = replaced(text, special, std::string("\\") + special);
        return text;
    };
    std::string names;
    std::string cases;
    for (const CommandText& command : commands) {
        names += "        " + single_quoted(command.name + ":" + meaning(command.meaning)) + "\n";
        cases += "        " + command.name + ")\n            _arguments";
        for (const OptionText& option : command.options) {
            cases += " \\\n                " +
                     single_quoted("*" + option.name + "[" + meaning(option.meaning) + "]" +
                                   (option.value.empty() ? "" : zsh_value(option)));
        }
        const bool named = !command.arguments.empty() && !command.arguments.front().choices.empty();
        cases += " \\\n                " +
                 (named ? single_quoted("1" + zsh_value(command.arguments.front()))
                        : std::string("'*:file:_files'")) +
                 "\n            ;;\n";
    }
    return "#compdef sonarsim\n"
           "# Completion of sonarsim for zsh.\n"
           "_sonarsim() {\n"
           "    local -a commands=(\n" +
           names +
           "    )\n"
           "    if ((CURRENT == 2)); then\n"
           "        _describe command commands\n"
           "        return\n"
           "    fi\n"
           "    shift words\n"
           "    ((CURRENT--))\n"
           "    case $words[1] in\n" +
           cases +
           "    esac\n"
           "}\n"
           "if [[ $funcstack[1] == _sonarsim ]]; then _sonarsim \"$@\"; else compdef _sonarsim "
           "sonarsim; fi\n";
}

std::string fish(const std::vector<CommandText>& commands) {
    const auto quoted = [](const std::string& text) {
        return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
    };
    std::string text =
        "# Completion of sonarsim for fish.\n"
        "complete -c sonarsim -n __fish_use_subcommand -f\n";
    for (const CommandText& command : commands) {
        text += "complete -c sonarsim -n __fish_use_subcommand -a " + command.name + " -d " +
                quoted(command.meaning) + "\n";
        const std::string seen =
            "complete -c sonarsim -n '__fish_seen_subcommand_from " + command.name + "'";
        for (const OptionText& option : command.options) {
            text += seen + " -l " + option.name.substr(2);
            if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
            if (!option.choices.empty()) text += " -x -a " + quoted(joined(option.choices));
            if (option.choices.empty() && !option.value.empty()) text += " -r";
            text += " -d " + quoted(option.meaning) + "\n";
        }
        for (const OptionText& argument : command.arguments) {
            if (!argument.choices.empty())
                text += seen + " -f -a " + quoted(joined(argument.choices)) + "\n";
        }
    }
    return text;
}

}  // namespace

void add_completion(CLI::App& app, int& exit_code) {
    using Write = std::string (*)(const std::vector<CommandText>&);
    static const std::map<std::string, Write> shells{{"bash", bash}, {"fish", fish}, {"zsh", zsh}};
    CLI::App& command = *app.add_subcommand(
        "completion", "Prints the script that completes command lines in a shell");
    auto shell = std::make_shared<std::string>();
    command.add_option("shell", *shell, "The shell")
        ->required()
        ->check(CLI::IsMember({"bash", "fish", "zsh"}));
    command.callback([shell, &app, &exit_code] {
        fmt::print("{}", shells.at(*shell)(command_texts(app)));
        exit_code = exit_done;
    });
}

}  // namespace sonarsim
