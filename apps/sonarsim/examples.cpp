#include <array>
#include <string>

#include "command_texts.h"

namespace sonarsim {

namespace {

struct Example {
    const char* command;  ///< "" for the program itself
    const char* line;
};

constexpr std::array all_examples{
    Example{"", "sonarsim render mission.yaml"},
    Example{"", "sonarsim render --help"},
    Example{"render", "sonarsim render mission.yaml"},
    Example{"render",
            "sonarsim render mission.yaml --out out/noisy --set sensors.fls.noise.add_sigma=0.2"},
    Example{"render", "sonarsim render mission.yaml --shard 2/8 --out out/part2"},
    Example{"verify", "sonarsim verify out/hull"},
    Example{"merge", "sonarsim merge out/part1 out/part2 out/hull"},
    Example{"validate", "sonarsim validate mission.yaml"},
    Example{"validate", "sonarsim validate mission.yaml --json"},
    Example{"validate", "sonarsim validate mission.yaml --strict"},
    Example{"preview", "sonarsim preview mission.yaml --ping 20"},
    Example{"gallery", "sonarsim gallery out/hull"},
    Example{"status", "sonarsim status out/part1 out/part2"},
    Example{"inspect", "sonarsim inspect hull.glb"},
    Example{"report", "sonarsim report mission.yaml"},
    Example{"report", "sonarsim report --hard"},
    Example{"keys", "sonarsim keys --json"},
    Example{"warnings", "sonarsim warnings"},
    Example{"schema", "sonarsim schema > sonarsim.schema.json"},
    Example{"import-holoocean",
            "sonarsim import-holoocean scenario.json --out mission.yaml --scene hull.glb"},
    Example{"completion",
            "sonarsim completion bash > ~/.local/share/bash-completion/completions/sonarsim"},
    Example{"man", "sonarsim man | man -l -"},
};

std::string footer_of(const std::string& command) {
    std::string text;
    for (const Example& example : all_examples) {
        if (command == example.command)
            text += (text.empty() ? "Examples:\n  " : "\n  ") + std::string(example.line);
    }
    return text;
}

}  // namespace

void add_examples(CLI::App& app) {
    app.footer(footer_of(""));
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        command->footer(footer_of(command->get_name()));
}

}  // namespace sonarsim
