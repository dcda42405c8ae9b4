#include <malloc.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <system_error>

#include "commands.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/text.h"
#include "output/format/png.h"

namespace {

using namespace sonarsim;

// Memory may also be missing for the stack of another thread.
constexpr const char* out_of_memory =
    "out of memory: use fewer threads (-j), fewer bins or a smaller scene";

/// Lets the C library keep freed memory. A ping allocates and frees a few megabytes; handing them
/// back to the kernel each time and faulting them in again takes a third of the ping's time.
void keep_freed_memory() {
    constexpr int max_threshold = 32 << 20;  // the C library's limit
    // NOLINTBEGIN(concurrency-mt-unsafe): there are no other threads yet
    mallopt(M_MMAP_THRESHOLD, max_threshold);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    // NOLINTEND(concurrency-mt-unsafe)
}

std::string version_text() {
    const BuildInfo build = build_info();
    return std::string("sonarsim ") + build.version + "\nbuilt by " + build.compiler + " with " +
           build.flags + "; arithmetic " + build.arithmetic + "; PNG files by " + png_encoder;
}

/// The message for an unknown word on the command line, with the nearest known one.
std::string unknown_word(const CLI::App& app, const std::string& word) {
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
    if (word.ends_with(".yaml") || word.ends_with(".yml"))
        return "a subcommand must come first, as in: sonarsim render " + word;
    return "unknown subcommand '" + word + "'" + did_you_mean(word, known);
}

/// The message for a command line with an error, and how to get help.
std::string usage_message(const CLI::App* app, const CLI::Error& error) {
    const std::vector<std::string> left_over = app->remaining(true);
    const std::string what =
        left_over.empty() ? error.what() : unknown_word(*app, left_over.front());
    return "error: " + printable(what) + "\nRun with --help for more information.\n";
}

int run(int argc, char** argv) {
    CLI::App app("Renders sonar datasets from a mission: a scene, a trajectory and sonars.");
    app.name("sonarsim");
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    app.failure_message(usage_message);
    int exit_code = exit_done;
    // In the order of the groups of --help.
    for (const auto add : {add_new, add_render, add_merge, add_preview, add_inspect, add_validate,
                           add_verify, add_status, add_report})
        add(app, exit_code);
    add_python_tools(app);
    for (const auto add : {add_preset, add_keys, add_warnings})
        add(app, exit_code);
    add_examples(app, {"sonarsim render mission.yaml", "sonarsim render --help"});
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_bad_input;
    }
    return exit_code;
}

/// Flushes the output, since a full disk may show only then.
void finish_printing() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
}

}  // namespace

int main(int argc, char** argv) {
    // A file size limit (ulimit -f) then is an error with a reason instead of a signal.
    std::signal(SIGXFSZ, SIG_IGN);
    keep_freed_memory();
    start_logging({});
    try {
        become_python_tool(argc, argv);
        const int exit_code = run(argc, argv);
        finish_printing();
        return exit_code;
    } catch (const InputError& error) {
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);)
            spdlog::error("{}", line);
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        spdlog::error(out_of_memory);
        return exit_failed;
    } catch (const std::filesystem::filesystem_error& error) {
        spdlog::error("{}: {}", error.path1().string(), error.code().message());
        return exit_failed;
    } catch (const std::system_error& error) {
        const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
        spdlog::error("{}", no_thread ? out_of_memory : error.what());
        return exit_failed;
    } catch (const std::exception& error) {
        spdlog::error("{}", error.what());
        return exit_failed;
    }
}
