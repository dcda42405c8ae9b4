#pragma once

#include <stdexcept>
#include <string>

namespace sonarsim {

/// Where in a user's file something stands. Lines and columns count from 1; 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", without the parts that are unknown.
    std::string text() const;
};

/// The user's input is wrong. The message says where, what and what would be right; the program
/// ends with exit code 2.
class InputError : public std::runtime_error {
  public:
    InputError(const Location& where, const std::string& what);
    explicit InputError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace sonarsim
