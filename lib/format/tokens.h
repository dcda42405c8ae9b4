#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

inline constexpr int shortest_run = 4;
inline constexpr int longest_run = 258;
/// A token is a byte, or 256 plus the length of a run.
inline constexpr int run_token = 256;
inline constexpr std::size_t tokens_known = run_token + longest_run + 1;

/// Literal bytes and the run after them; the last stretch of a block may have no run.
struct Stretch {
    std::uint32_t literals;
    std::uint32_t run;
};

/// A block of bytes as stretches, and how often each token occurs.
struct Tokens {
    const std::uint8_t* bytes;
    std::vector<Stretch> stretches;
    std::array<std::uint32_t, tokens_known> counts{};
};

/// The tokens of the bytes [begin, end) of `all`, which must outlive them. A run repeats the bytes
/// `back` before it, and begins at the first possible byte.
Tokens tokens_of(std::span<const std::uint8_t> all, std::size_t begin, std::size_t end,
                 std::ptrdiff_t back);

}  // namespace sonarsim
