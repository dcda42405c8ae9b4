#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sonarsim {

/// Where in a user's file something stands. Lines and columns count from 1; 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", without the parts that are unknown.
    std::string text() const;
};

/// The user's input is wrong. The message says where, what and what would be right, in one line for
/// each fault; the program ends with exit code 2.
class InputError : public std::runtime_error {
  public:
    InputError(const Location& where, const std::string& what);
    explicit InputError(const std::string& what) : std::runtime_error(what) {}
};

/// Gathers the faults of an input, so that its user is told all of them at once.
class Problems {
  public:
    /// Runs `check` and keeps the InputError that it throws. Returns whether it threw none.
    template <class Check>
    bool attempt(Check&& check) {
        try {
            check();
            return true;
        } catch (const InputError& error) {
            add(error);
            return false;
        }
    }
    void add(const InputError& error);

    /// How many faults there were, including those beyond the most that are kept.
    std::size_t count() const { return count_; }
    /// One InputError with a line for each, in the order in which they were found. Does nothing
    /// where there is none.
    void raise() const;

  private:
    static constexpr std::size_t most_kept = 50;

    std::vector<std::string> kept_;  ///< each once
    std::size_t count_ = 0;
};

}  // namespace sonarsim
