#pragma once

#include <string>

#include "core/error.h"

namespace sonarsim {

/// Adds to the error of a file the location at which another file names this file.
inline InputError named_at(const InputError& fault, const Location& where) {
    return InputError(std::string(fault.what()) + "; " + where.text() + " names it");
}

}  // namespace sonarsim
