#include "core/hash.h"

#include <nettle/sha2.h>
#include <spdlog/fmt/fmt.h>

#include <array>
#include <vector>

#include "core/file.h"
#include "core/text.h"

namespace sonarsim {

namespace {

std::string digest(sha256_ctx& hash) {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes;
    sha256_digest(&hash, bytes.size(), bytes.data());
    return hex_text(bytes);
}

}  // namespace

std::string fnv1a_128(std::string_view bytes) {
    __extension__ using Wide = unsigned __int128;
    constexpr Wide prime = (Wide{1} << 88) + 0x13b;
    Wide hash = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
    for (const char byte : bytes)
        hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
    return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64),
                       static_cast<std::uint64_t>(hash));
}

std::string sha256(std::string_view bytes) {
    sha256_ctx hash;
    sha256_init(&hash);
    sha256_update(&hash, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    return digest(hash);
}

std::string sha256_of_file(const std::filesystem::path& path) {
    const Descriptor file(path, O_RDONLY);
    if (file.get() < 0) throw_errno("cannot read", path);
    sha256_ctx hash;
    sha256_init(&hash);
    std::vector<std::uint8_t> piece(std::size_t{1} << 18);
    for (std::size_t size = piece.size(); size == piece.size();) {
        const auto got = move_all(piece.size(), [&](std::size_t done) {
            return ::read(file.get(), piece.data() + done, piece.size() - done);
        });
        if (!got) throw_errno("cannot read", path);
        size = *got;
        sha256_update(&hash, size, piece.data());
    }
    return digest(hash);
}

}  // namespace sonarsim
