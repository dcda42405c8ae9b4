#include "core/module.h"

#include <dlfcn.h>

#include <system_error>
#include <utility>

namespace sonarsim {

namespace {

/// Modules lie below the folder of the program or of its tests in a build tree, and next to bin/
/// after an installation; those of the package of Python below the folders above its own module. A
/// program that only links the library finds the installed ones. "": none.
std::filesystem::path file_of_module(const std::string& name) {
    const std::filesystem::path file = "lib/sonarsim/libsonarsim_" + name + ".so";
    std::error_code ignored;
    // PREFIX/lib/python3/dist-packages/sonarsim/ holds the module of Python.
    for (const auto& [start, levels] :
         {std::pair{module_of_python(), 5},
          std::pair{std::filesystem::read_symlink("/proc/self/exe", ignored), 3}}) {
        std::filesystem::path folder = start.parent_path();
        for (int level = 0; !folder.empty() && level < levels; ++level) {
            if (std::filesystem::exists(folder / file, ignored)) return folder / file;
            folder = folder.parent_path();
        }
    }
    const std::filesystem::path installed = SONARSIM_PREFIX / file;
    return std::filesystem::exists(installed, ignored) ? installed : "";
}

}  // namespace

std::filesystem::path module_of_python() {
    static const char here = 0;
    Dl_info info{};
    if (::dladdr(&here, &info) == 0 || info.dli_fname == nullptr) return {};
    const std::filesystem::path file = info.dli_fname;
    std::error_code unknown;
    return file.extension() == ".so" ? std::filesystem::canonical(file, unknown) : "";
}

void* module_symbol(const std::string& name, const char* symbol, const std::string& package,
                    const Location& where) {
    const std::string title = "the module libsonarsim_" + name + ".so";
    const std::filesystem::path file = file_of_module(name);
    if (file.empty()) {
        refuse(where,
               "cannot be read: {} is not installed with this program; install {} and build "
               "sonarsim again, or install sonarsim's Debian package",
               title, package);
    }
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
        const char* reason = dlerror();  // NOLINT(concurrency-mt-unsafe): glibc has one a thread
        refuse(where, "cannot be read: {} cannot be loaded ({}); install {}", title,
               reason ? reason : "unknown reason", package);
    }
    void* found = dlsym(module, symbol);
    if (found == nullptr) {
        refuse(where,
               "cannot be read: {} belongs to another version of sonarsim; install or build it "
               "again",
               file.string());
    }
    return found;
}

}  // namespace sonarsim
