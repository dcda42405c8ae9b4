#pragma once

#include <spdlog/fmt/fmt.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sonarsim {

/// A position in a user's file. Lines and columns count from 1; 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", without the parts that are unknown.
    std::string text() const;
};

/// Wrong input by the user: a line for each error with place, fault and cure. Exit code 2.
class InputError : public std::runtime_error {
  public:
    InputError(const Location& where, const std::string& what);
    explicit InputError(const std::string& what) : std::runtime_error(what) {}
};

/// Throws InputError at the place, with the parts in place of each {} of the message.
template <class... Parts>
[[noreturn]] void refuse(const Location& where, fmt::format_string<Parts...> message,
                         Parts&&... parts) {
    throw InputError(where, fmt::format(message, std::forward<Parts>(parts)...));
}

/// Collects the errors of an input, so that the user sees all of them at once.
class ErrorList {
  public:
    /// Runs `check` and keeps the InputError that it throws. Returns true if it threw none.
    bool attempt(auto&& check) {
        try {
            check();
            return true;
        } catch (const InputError& error) {
            add(error);
            return false;
        }
    }
    void add(const InputError& error);

    /// Number of errors, including those beyond the first `max_kept`.
    std::size_t count() const { return count_; }
    /// Throws one InputError with a line for each error, in their order. None: does nothing.
    void raise() const;

  private:
    static constexpr std::size_t max_kept = 50;

    std::vector<std::string> kept_;  ///< without duplicates
    std::size_t count_ = 0;
};

/// Runs `read`, which reads a file. Its error gets the place at which another file names it.
auto read_named_at(const Location& place, const auto& read) {
    try {
        return read();
    } catch (const InputError& error) {
        if (place.file.empty()) throw;
        throw InputError(std::string(error.what()) + "; " + place.text() + " names it");
    }
}

}  // namespace sonarsim
