#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The FNV-1a hash of 128 bits, as 32 hexadecimal digits. It tells inputs apart; it is no defence
/// against somebody who makes two inputs agree on purpose.
std::string fnv1a_128(std::string_view bytes);

}  // namespace sonarsim
