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

/// Appends bits to a string of bytes, lowest first.
class BitWriter {
  public:
    explicit BitWriter(std::string start) : bytes_(std::move(start)), end_(bytes_.size()) {}

    /// Makes room for `bits` further bits; must be called before they are put.
    void reserve(std::uint64_t bits) { bytes_.resize(end_ + bits / 8 + 2 * sizeof(buffer_)); }
    void put(const BitCode& code) { put(code.value, code.bits); }
    /// Appends up to 56 bits.
    void put(std::uint64_t value, int bits) {
        buffer_ |= value << held_;
        held_ += bits;
        std::memcpy(bytes_.data() + end_, &buffer_, sizeof(buffer_));
        end_ += static_cast<std::size_t>(held_ / 8);
        buffer_ >>= held_ & ~7;
        held_ &= 7;
    }
    /// Fills the last byte with zeros.
    void align() {
        reserve(8);
        if (held_ > 0) put(0, 8 - held_);
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
    int held_ = 0;
};

}  // namespace sonarsim
