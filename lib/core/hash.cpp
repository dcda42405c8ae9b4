#include "core/hash.h"

#include <fcntl.h>
#include <nettle/sha2.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <vector>

#include "core/file.h"

namespace sonarsim {

namespace {

class Sha256 {
  public:
    Sha256() { sha256_init(&context_); }
    void add(std::string_view bytes) {
        sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    }
    std::string digest() {
        std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes;
        sha256_digest(&context_, bytes.size(), bytes.data());
        std::string text;
        for (const std::uint8_t byte : bytes) {
            text += "0123456789abcdef"[byte >> 4U];
            text += "0123456789abcdef"[byte & 15U];
        }
        return text;
    }

  private:
    sha256_ctx context_;
};

}  // namespace

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

std::string sha256(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digest();
}

std::string sha256_of_file(const std::filesystem::path& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw_errno("cannot read", path);
    Sha256 hash;
    std::vector<char> piece(std::size_t{1} << 18);
    ssize_t got = 1;
    while (got != 0) {
        got = ::read(fd, piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) break;
        hash.add({piece.data(), static_cast<std::size_t>(got)});
    }
    const int reason = errno;
    ::close(fd);
    errno = reason;
    if (got < 0) throw_errno("cannot read", path);
    return hash.digest();
}

}  // namespace sonarsim
