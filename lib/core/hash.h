#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The 128-bit FNV-1a hash, as 32 hexadecimal digits. It is not cryptographic: inputs with the same
/// hash can be made on purpose.
std::string fnv1a_128(std::string_view bytes);

}  // namespace sonarsim
