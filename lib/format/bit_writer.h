#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace sonarsim {

/// A bit string; its first bit is the lowest.
struct BitCode {
    std::uint32_t value = 0;
    int bits = 0;
};

/// Writes bits, lowest first. A local cursor stays in registers, unlike the members of a BitWriter.
struct BitCursor {
    static constexpr int most_bits = 56;

    char* at;              ///< the next byte
    std::uint64_t buffer;  ///< bits that fill no byte yet
    unsigned held;         ///< their number, less than 8

    void put(const BitCode& code) { put(code.value, code.bits); }
    /// Writes up to most_bits bits.
    void put(std::uint64_t value, int bits) {
        buffer |= value << held;
        held += static_cast<unsigned>(bits);
        std::memcpy(at, &buffer, sizeof(buffer));
        at += held / 8;
        buffer >>= held & 56U;
        held &= 7U;
    }
};

/// Appends bits to a string of bytes, lowest first.
class BitWriter {
  public:
    explicit BitWriter(std::string start) : bytes_(std::move(start)), end_(bytes_.size()) {}

    /// Begins to write at most `bits` bits, which end() adds.
    BitCursor begin(std::uint64_t bits) {
        bytes_.resize(end_ + bits / 8 + 2 * sizeof(buffer_));
        return {bytes_.data() + end_, buffer_, held_};
    }
    void end(const BitCursor& cursor) {
        end_ = static_cast<std::size_t>(cursor.at - bytes_.data());
        buffer_ = cursor.buffer;
        held_ = cursor.held;
    }
    /// Fills the last byte with zeros.
    void align() {
        BitCursor cursor = begin(8);
        if (held_ > 0) cursor.put(0, 8 - static_cast<int>(held_));
        end(cursor);
    }
    /// Takes the whole bytes written so far out of the writer.
    std::string take() {
        bytes_.resize(end_);
        end_ = 0;
        return std::exchange(bytes_, {});
    }

  private:
    std::string bytes_;
    std::size_t end_;  ///< number of whole bytes
    std::uint64_t buffer_ = 0;
    unsigned held_ = 0;
};

}  // namespace sonarsim
