#pragma once

#include <filesystem>
#include <string>

namespace sonarsim {

/// The module that is linked with OpenImageIO, and Debian's package to build it with.
inline constexpr const char* image_module = "images";
inline constexpr const char* image_package = "libopenimageio-dev";

/// The module of Python that holds this code; empty in a program.
std::filesystem::path module_of_python();

/// The address of `symbol` in lib/sonarsim/libsonarsim_NAME.so next to or above the program, or the
/// module of Python. A module links a library that few missions need, so that the program starts
/// without it. It stays loaded. InputError without the module, or without the library that it
/// links: the sentence names `package`, Debian's package to build the module with.
void* module_symbol(const std::string& name, const char* symbol, const std::string& package);

}  // namespace sonarsim
