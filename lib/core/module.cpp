#include "core/module.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace sonarsim {

namespace {

/// Modules lie below the folder of the program or of its tests in a build tree, and next to bin/
/// after an installation. A program that only links the library finds the installed ones. "": none.
std::filesystem::path file_of_module(const std::string& name) {
    const std::filesystem::path file = "lib/sonarsim/libsonarsim_" + name + ".so";
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    std::filesystem::path folder = program.parent_path();
    for (int level = 0; !error && level < 3; ++level, folder = folder.parent_path()) {
        std::error_code ignored;
        if (std::filesystem::exists(folder / file, ignored)) return folder / file;
    }
    const std::filesystem::path installed = SONARSIM_PREFIX / file;
    std::error_code ignored;
    return std::filesystem::exists(installed, ignored) ? installed : "";
}

}  // namespace

void* module_symbol(const std::string& name, const char* symbol, const std::string& package) {
    const std::string title = "the module libsonarsim_" + name + ".so";
    const std::filesystem::path file = file_of_module(name);
    if (file.empty()) {
        throw InputError(title + " is not installed with this program; install " + package +
                         " and build sonarsim again, or install sonarsim's Debian package");
    }
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
        const char* reason = dlerror();  // NOLINT(concurrency-mt-unsafe): glibc has one a thread
        throw InputError(title + " cannot be loaded (" + (reason ? reason : "unknown reason") +
                         "); install " + package);
    }
    void* found = dlsym(module, symbol);
    if (found == nullptr) {
        throw InputError(file.string() +
                         " belongs to another version of sonarsim; install or build it again");
    }
    return found;
}

}  // namespace sonarsim
