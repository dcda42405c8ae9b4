#include "core/sha256.h"

#include <doctest/doctest.h>

#include <string>
#include <system_error>

#include "core/file.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_CASE("SHA-256 of the published test vectors, in memory and in a file read in pieces") {
    // FIPS 180-2, appendix B, and NIST's SHA256ShortMsg for the empty message.
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const std::string bytes(1'000'000, 'a');
    const std::string sum = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
    CHECK(sha256(bytes) == sum);
    const TemporaryFolder temporary;
    write_file(temporary.path / "a", bytes);
    CHECK(sha256_of_file(temporary.path / "a") == sum);
    CHECK_THROWS_AS(sha256_of_file(temporary.path / "none"), std::system_error);
    CHECK_THROWS_AS(sha256_of_file(temporary.path), std::system_error);
}
