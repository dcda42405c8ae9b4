#include "core/hash.h"

namespace sonarsim {

std::string fnv1a_128(std::string_view bytes) {
    __extension__ using Wide = unsigned __int128;
    constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    Wide hash = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
    for (const char byte : bytes)
        hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
    std::string out;
    for (int shift = 124; shift >= 0; shift -= 4) {
        out += "0123456789abcdef"[static_cast<unsigned>(hash >> shift) & 15U];
    }
    return out;
}

}  // namespace sonarsim
