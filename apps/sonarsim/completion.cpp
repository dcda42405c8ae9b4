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

std::string choices_of(const OptionText& option) {
    return fmt::format("{}", fmt::join(option.choices, " "));
}

/// The functions of bash. NAMES, OPTIONS and CHOICES are filled in.
constexpr const char* bash_script = R"(# Completion of sonarsim for bash.
_sonarsim() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local command='' word options='' words=''
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ $word == -* ]] || { command=$word; break; }
    done
    case $command in
        '') words='NAMES --help --version' ;;
OPTIONS    esac
    case "$command $before" in
CHOICES    esac
    [[ -z $words && $current == -* ]] && words=$options
    if [[ -n $words ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    fi
}
complete -F _sonarsim sonarsim
)";

std::string bash(const std::vector<CommandText>& commands) {
    std::string names;
    std::string options;
    std::string choices;
    for (const CommandText& command : commands) {
        names += (names.empty() ? "" : " ") + command.name;
        std::string own;
        for (const OptionText& option : command.options)
            own += (own.empty() ? "" : " ") + option.name;
        options += fmt::format("        {}) options='{}' ;;\n", command.name, own);
        const auto add_choices = [&](const OptionText& option, const std::string& before) {
            if (option.choices.empty()) return;
            choices += fmt::format("        '{} {}') words='{}' ;;\n", command.name, before,
                                   choices_of(option));
        };
        for (const OptionText& option : command.options)
            add_choices(option, option.name);
        for (const OptionText& argument : command.arguments)
            add_choices(argument, command.name);
    }
    return replaced(replaced(replaced(bash_script, "NAMES", names), "OPTIONS", options), "CHOICES",
                    choices);
}

/// The functions of zsh. NAMES and CASES are filled in.
constexpr const char* zsh_script = R"(#compdef sonarsim
# Completion of sonarsim for zsh.
_sonarsim() {
    local -a commands=(
NAMES    )
    if ((CURRENT == 2)); then
        _describe command commands
        return
    fi
    shift words
    ((CURRENT--))
    case $words[1] in
CASES    esac
}
if [[ $funcstack[1] == _sonarsim ]]; then _sonarsim "$@"; else compdef _sonarsim sonarsim; fi
)";

std::string zsh(const std::vector<CommandText>& commands) {
    const auto quoted = [](const std::string& text) {
        return "'" + replaced(text, "'", "'\\''") + "'";
    };
    const auto meaning = [](std::string text) {
        for (const char* special : {"[", "]", ":"})
            text = replaced(text, special, std::string("\\") + special);
        return text;
    };
    // A positional argument has no value name, and an empty message has another meaning in zsh.
    const auto value = [](const OptionText& option) {
        const std::string& message = option.value.empty() ? option.name : option.value;
        return option.choices.empty() ? ":" + option.value + ":_files"
                                      : ":" + message + ":(" + choices_of(option) + ")";
    };
    std::string names;
    std::string cases;
    for (const CommandText& command : commands) {
        names += "        " + quoted(command.name + ":" + meaning(command.meaning)) + "\n";
        cases += "        " + command.name + ")\n            _arguments";
        for (const OptionText& option : command.options) {
            cases +=
                " \\\n                " + quoted("*" + option.name + "[" + meaning(option.meaning) +
                                                 "]" + (option.value.empty() ? "" : value(option)));
        }
        const bool named = !command.arguments.empty() && !command.arguments.front().choices.empty();
        cases += " \\\n                " +
                 (named ? quoted("1" + value(command.arguments.front())) : "'*:file:_files'") +
                 "\n            ;;\n";
    }
    return replaced(replaced(zsh_script, "NAMES", names), "CASES", cases);
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
            if (!option.choices.empty()) text += " -x -a " + quoted(choices_of(option));
            if (option.choices.empty() && !option.value.empty()) text += " -r";
            text += " -d " + quoted(option.meaning) + "\n";
        }
        for (const OptionText& argument : command.arguments) {
            if (!argument.choices.empty())
                text += seen + " -f -a " + quoted(choices_of(argument)) + "\n";
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
    add_examples(
        command,
        {"sonarsim completion bash > ~/.local/share/bash-completion/completions/sonarsim"});
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
