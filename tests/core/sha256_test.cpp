#include "core/sha256.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/file.h"
#include "core/sha256_of_all.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE_BEGIN("core");

TEST_CASE("SHA-256 of the published test vectors") {
    // FIPS 180-2, appendix B, and NIST's SHA256ShortMsg for the empty message.
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(sha256(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 does not depend on the pieces") {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += static_cast<char>(i * 7 + i / 31);
    for (const std::size_t length : {0, 1, 55, 56, 63, 64, 65, 119, 120, 128, 1000}) {
        const std::string whole = sha256(std::string_view(text).substr(0, length));
        for (const std::size_t piece : {1, 3, 63, 64, 65, 200}) {
            Sha256 hash;
            for (std::size_t at = 0; at < length; at += piece)
                hash.add(std::string_view(text).substr(at, std::min(piece, length - at)));
            CHECK_MESSAGE(hash.digest() == whole, length << " by " << piece);
        }
    }
}

TEST_CASE("SHA-256 of several strings side by side is that of each") {
    std::mt19937 random(9);
    for (int round = 0; round < 60; ++round) {
        std::vector<std::string> texts(random() % 10);
        std::vector<std::string> expected;
        for (std::string& text : texts) {
            // Many of equal lengths, and of whole blocks.
            text.resize(random() % 3 == 0 ? 64 * (random() % 9) : random() % 700);
            for (char& letter : text)
                letter = static_cast<char>(random());
            expected.push_back(sha256(text));
        }
        CHECK(sha256_of_all(std::vector<std::string_view>(texts.begin(), texts.end())) == expected);
    }
}

TEST_CASE("SHA-256 without special instructions works the same state out") {
    // "abc" as one block: its bytes, a set bit, zeros, 24 bits.
    std::string block = "abc\x80" + std::string(59, '\0') + '\x18';
    std::array<std::uint32_t, 8> state{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                       0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    REQUIRE(block.size() == 64);
    sha256_blocks_portable(state, block.data(), 1);
    CHECK(state == std::array<std::uint32_t, 8>{0xba7816bf, 0x8f01cfea, 0x414140de, 0x5dae2223,
                                                0xb00361a3, 0x96177a9c, 0xb410ff61, 0xf20015ad});
}

TEST_CASE("SHA-256 of a file that is longer than what is read at a time") {
    const TemporaryFolder temporary;
    const std::string bytes(1'000'000, 'a');
    write_file(temporary.path / "a", bytes);
    CHECK(sha256_of_file(temporary.path / "a") == sha256(bytes));
    CHECK_THROWS_AS(sha256_of_file(temporary.path / "none"), std::system_error);
    CHECK_THROWS_AS(sha256_of_file(temporary.path), std::system_error);
}

TEST_SUITE_END();
