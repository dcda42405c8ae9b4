#include "commands.h"

#include <string>

namespace sonarsim {

void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
    std::string text = "Examples:";
    for (const char* line : lines)
        text += std::string("\n  ") + line;
    command.footer(text);
}

}  // namespace sonarsim
