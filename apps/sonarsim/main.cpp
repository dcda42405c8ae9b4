#include <malloc.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "commands.h"
#include "core/error.h"
#include "logging.h"

namespace {

using namespace sonarsim;

/// Lets the C library keep freed memory. A ping allocates and frees a few megabytes; handing them
/// back to the kernel each time and faulting them in again takes a third of the ping's time.
void keep_freed_memory() {
    constexpr int most = 32 << 20;  // what the C library takes
    mallopt(M_MMAP_THRESHOLD, most);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

int run(int argc, char** argv) {
    CLI::App app("Renders sonar datasets from a mission: a scene, a trajectory and sonars.");
    app.name("sonarsim");
    app.set_version_flag("--version", "sonarsim " SONARSIM_VERSION);
    app.require_subcommand(1);
    int exit_code = exit_done;
    add_render(app, exit_code);
    add_validate(app, exit_code);
    add_inspect(app, exit_code);
    add_report(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_bad_input;
    }
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    try {
        return run(argc, argv);
    } catch (const InputError& error) {
        spdlog::error("{}", error.what());
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        spdlog::error("out of memory: use fewer threads (-j), fewer bins or a smaller scene");
        return exit_failed;
    } catch (const std::exception& error) {
        spdlog::error("{}", error.what());
        return exit_failed;
    }
}
