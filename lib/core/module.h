#pragma once

#include <filesystem>
#include <string>

#include "core/error.h"

namespace sonarsim {

/// The module of Python that holds this code; empty in a program.
std::filesystem::path module_of_python();

/// The address of `symbol` in lib/sonarsim/libsonarsim_NAME.so next to or above the program, or the
/// module of Python. A module links a library that few missions need, so that the program starts
/// without it. It stays loaded. InputError at `where`, the file to read, without the module, or
/// without the library that it links: it names `package`, Debian's package to build it with.
void* module_symbol(const std::string& name, const char* symbol, const std::string& package,
                    const Location& where);

}  // namespace sonarsim
