#include "commands.h"
#include "core/error.h"
#include "core/text.h"
#include "input/mission/reference.h"
#include "run/checks/warning.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

/// The keys whose path has a text. InputError if there is none.
std::vector<SectionReference> with_text(std::vector<SectionReference> sections,
                                        const std::string& text) {
    for (SectionReference& section : sections) {
        std::erase_if(section.keys, [&](const KeyReference& key) {
            return (section.path + "." + key.name).find(text) == std::string::npos;
        });
        std::erase_if(section.checks, [&](const std::string& check) {
            return check.find(text) == std::string::npos;
        });
    }
    std::erase_if(sections, [](const SectionReference& section) { return section.keys.empty(); });
    if (sections.empty()) throw InputError("no key has '" + printable(text) + "' in its path");
    return sections;
}

struct KeysArguments {
    std::string text;  ///< "": every key
    bool json = false;
};

int print_keys(const KeysArguments& arguments) {
    const std::vector<SectionReference> sections = mission_reference(sonar_keys());
    if (arguments.json)
        fmt::print("{}\n", reference_schema(sections, sonar_keys()).dump(1));
    else
        fmt::print("{}", reference_markdown(with_text(sections, arguments.text)));
    return exit_done;
}

}  // namespace

/// For scripts/write_keys.sh, which puts the table into docs/warnings.md; --help does not list it.
void add_warnings(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand("warnings", "Prints the table of docs/warnings.md");
    command.group("");
    command.callback([&exit_code] {
        fmt::print("{}", warning_table_markdown());
        exit_code = exit_done;
    });
}

void add_keys(CLI::App& app, int& exit_code) {
    auto [command, arguments] = add_command(
        app, exit_code, "keys", "Prints every key of a mission with its default, range and meaning",
        "Learn", {"sonarsim keys noise", "sonarsim keys --json > sonarsim.schema.json"},
        print_keys);
    command.add_option("text", arguments.text,
                       "A part of the key's path, as noise (default: every key)");
    command.add_flag("--json", arguments.json,
                     "Prints a JSON Schema, for editors that complete and check missions");
}

}  // namespace sonarsim
