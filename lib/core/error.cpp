#include "core/error.h"

namespace sonarsim {

std::string Location::text() const {
    std::string out = file;
    if (line > 0) out += ":" + std::to_string(line);
    if (line > 0 && column > 0) out += ":" + std::to_string(column);
    return out;
}

InputError::InputError(const Location& where, const std::string& what)
    : std::runtime_error(where.text() + ": " + what) {}

}  // namespace sonarsim
