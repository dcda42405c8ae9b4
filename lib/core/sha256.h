#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sonarsim {

/// SHA-256 (FIPS 180-4) of bytes that are added in pieces. All processors give the same digest;
/// those with SHA instructions are several times as fast.
class Sha256 {
  public:
    void add(std::string_view bytes);
    /// 64 hexadecimal digits, as sha256sum prints them. Call it once, after the last piece.
    std::string digest();

  private:
    static constexpr std::size_t block_bytes = 64;

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<char, block_bytes> rest_{};  ///< the beginning of a block that is not full yet
    std::size_t rest_bytes_ = 0;
    std::uint64_t bytes_ = 0;
};

/// The SHA-256 of bytes in memory.
std::string sha256(std::string_view bytes);

/// The SHA-256 of a file of any length. std::system_error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Adds blocks of 64 bytes to `state` without SHA instructions. Sha256 calls it on processors that
/// lack them; it is public for tests.
void sha256_blocks_portable(std::array<std::uint32_t, 8>& state, const char* blocks,
                            std::size_t count);

}  // namespace sonarsim
