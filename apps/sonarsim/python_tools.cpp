#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "commands.h"
#include "core/error.h"

namespace sonarsim {

namespace {

struct PythonTool {
    const char* group;
    const char* name;
    const char* meaning;
};

constexpr PythonTool python_tools[] = {
    {"Use", "export", "Writes datasets in the layouts of trainers, robots and reconstruction"},
    {"Look", "gallery", "Writes a page for a browser that shows a dataset and its labels"},
    {"Check", "compare", "Compares the pings of two datasets or recordings by their statistics"},
    {"Use", "calibrate", "Fits a preset of the calibrated model to recorded pings"},
    {"Make", "import-holoocean",
     "Writes a mission from the sonars and poses of a HoloOcean scenario"},
    {"Make", "import-poses", "Writes the poses of a topic of an MCAP file as a trajectory"},
};

// Debian's numpy belongs to this interpreter, which need not be the first in PATH.
constexpr const char* debian_python = "/usr/bin/python3";

/// The value of an environment variable; `fallback` where it is unset or empty.
std::string environment(const char* name, const std::string& fallback) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): one thread
    return value != nullptr && *value != '\0' ? value : fallback;
}

/// The folder of the package: beside the program of a build tree, or below an installed prefix.
std::filesystem::path package_folder() {
    const std::filesystem::path beside =
        std::filesystem::read_symlink("/proc/self/exe").parent_path();
    for (const auto& folder : {beside / "python", beside.parent_path() / "lib/sonarsim/python"}) {
        if (std::filesystem::exists(folder / "sonarsim/command.py")) return folder;
    }
    throw InputError("the Python package of sonarsim does not lie beside the program in " +
                     beside.string() + "; build or install sonarsim again");
}

}  // namespace

void add_python_tools(CLI::App& app) {
    for (const PythonTool& tool : python_tools)
        app.add_subcommand(tool.name, tool.meaning)->group(tool.group);
}

void become_python_tool(int argc, char** argv) {
    if (argc < 2) return;
    const std::string_view name = argv[1];
    if (std::ranges::find(python_tools, name, &PythonTool::name) == std::end(python_tools)) return;
    std::string module = "sonarsim." + std::string(name);
    std::ranges::replace(module, '-', '_');
    std::string python = environment("SONARSIM_PYTHON", debian_python);
    const std::string other_folders = environment("PYTHONPATH", "");
    const std::string folders =
        package_folder().string() + (other_folders.empty() ? "" : ":" + other_folders);
    // NOLINTBEGIN(concurrency-mt-unsafe): there are no other threads yet
    setenv("PYTHONPATH", folders.c_str(), 1);
    // Without it Python would take modules from the current folder first.
    setenv("PYTHONSAFEPATH", "1", 1);
    // NOLINTEND(concurrency-mt-unsafe)
    std::string run_module = "-m";
    std::vector<char*> words{python.data(), run_module.data(), module.data()};
    words.insert(words.end(), argv + 2, argv + argc);
    words.push_back(nullptr);
    execvp(python.c_str(), words.data());
    throw InputError("cannot run " + python + ": " + std::generic_category().message(errno) +
                     "; install python3, or name an interpreter in SONARSIM_PYTHON");
}

}  // namespace sonarsim
