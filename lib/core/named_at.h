#pragma once

#include <string>

#include "core/error.h"

namespace sonarsim {

/// A fault of a file that another one names, with the place where it does.
inline InputError named_at(const InputError& fault, const Location& where) {
    return InputError(std::string(fault.what()) + "; " + where.text() + " names it");
}

}  // namespace sonarsim
