#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sonarsim {

/// The 128-bit FNV-1a hash, as 32 hexadecimal digits. It is not cryptographic.
std::string fnv1a_128(std::string_view bytes);

/// The SHA-256 (FIPS 180-4) of bytes in memory: 64 hexadecimal digits, as sha256sum prints them.
std::string sha256(std::string_view bytes);

/// The SHA-256 of a file of any length. std::system_error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace sonarsim
