#include "format/tokens.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace sonarsim {

namespace {

/// The number of bytes from `at` on that equal the bytes `back` before them, at most `most`.
int run_at(const std::uint8_t* at, std::ptrdiff_t back, int most) {
    int length = 0;
    while (length + 8 <= most) {
        std::uint64_t here = 0;
        std::uint64_t before = 0;
        std::memcpy(&here, at + length, sizeof(here));
        std::memcpy(&before, at + length - back, sizeof(before));
        if (here != before) return length + std::countr_zero(here ^ before) / 8;
        length += 8;
    }
    while (length < most && at[length] == at[length - back])
        ++length;
    return length;
}

/// The number of bytes from `at` on before the next run, or all up to `last`.
std::size_t literals_at(const std::uint8_t* const at, const std::uint8_t* const last,
                        std::ptrdiff_t back) {
    const std::uint8_t* next = at;
    while (last - next >= 32) {
        const __m256i here = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(next));
        const __m256i before = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(next - back));
        const auto equal =
            static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(here, before)));
        static_assert(shortest_run == 4);
        const std::uint32_t pairs = equal & equal >> 1;
        const std::uint32_t runs = pairs & pairs >> 2;
        if (runs != 0) return static_cast<std::size_t>(next - at + std::countr_zero(runs));
        next += 32 - (shortest_run - 1);
    }
    while (last - next >= shortest_run && run_at(next, back, shortest_run) < shortest_run)
        ++next;
    if (last - next < shortest_run) next = last;
    return static_cast<std::size_t>(next - at);
}

/// Counts bytes. Neighbours go to different counters, since a counter that was just written is slow
/// to read.
class ByteCounter {
  public:
    void add(const std::uint8_t* bytes, std::size_t count) {
        for (; count >= 4; count -= 4, bytes += 4) {
            for (std::size_t k = 0; k < 4; ++k)
                ++counts_[k][bytes[k]];
        }
        for (std::size_t k = 0; k < count; ++k)
            ++counts_[k][bytes[k]];
    }
    std::uint32_t count(std::size_t byte) const {
        return counts_[0][byte] + counts_[1][byte] + counts_[2][byte] + counts_[3][byte];
    }

  private:
    std::array<std::array<std::uint32_t, 256>, 4> counts_{};
};

}  // namespace

Tokens tokens_of(std::span<const std::uint8_t> all, std::size_t begin, std::size_t end,
                 std::ptrdiff_t back) {
    Tokens out;
    out.bytes = all.data() + begin;
    ByteCounter literals;
    const std::uint8_t* const last = all.data() + end;
    const std::uint8_t* at = out.bytes;
    while (at < last) {
        // The first `back` bytes of `all` have no byte to repeat.
        const auto alone = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(back - (at - all.data()), 0, last - at));
        const std::size_t count = alone + literals_at(at + alone, last, back);
        literals.add(at, count);
        at += count;
        const auto most = static_cast<int>(std::min<std::ptrdiff_t>(longest_run, last - at));
        const int run = most > 0 ? run_at(at, back, most) : 0;
        if (run > 0) ++out.counts[run_token + static_cast<std::size_t>(run)];
        at += run;
        out.stretches.push_back(
            {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(run)});
    }
    for (std::size_t byte = 0; byte < run_token; ++byte)
        out.counts[byte] = literals.count(byte);
    return out;
}

}  // namespace sonarsim
