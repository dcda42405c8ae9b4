#include "core/file.h"

#include <sys/stat.h>

#include "core/hash.h"
#include "support/test.h"

namespace fs = std::filesystem;

TEST_CASE("file: a temporary name is a hidden sibling, another one each time") {
    const fs::path one = temporary_name("out/a.png");
    CHECK(one.parent_path() == "out");
    CHECK(one.filename().string().starts_with(".a.png."));
    CHECK(is_temporary_name(one.filename().string()));
    CHECK(temporary_name("out/a.png") != one);
    // Names of other programs' files.
    for (const char* name :
         {"a.png", "a.part", ".part", ".a.mkv.part", ".a.mkv.0123456789ABCDEF.part",
          ".a.mkv.0123456789abcde.part", ".0123456789abcdef.part"})
        CHECK_FALSE(is_temporary_name(name));
}

TEST_CASE("file: reading refuses what is missing, too long or no regular file") {
    const TemporaryFolder folder;
    const auto refused = [&](const char* name, const std::string& reason) {
        const fs::path path = folder.path / name;
        CHECK_THROWS_WITH_AS(read_file(path, 4), (path.string() + ": " + reason).c_str(),
                             InputError);
    };
    write_file(folder.path / "long", "12345");
    fs::create_directory(folder.path / "folder");
    // Nobody writes to this one: an ordinary open() would wait for ever.
    REQUIRE(::mkfifo((folder.path / "fifo").c_str(), 0600) == 0);
    refused("none", "cannot open: No such file or directory");
    refused("long", "is 5 bytes long; at most 4 are read");
    refused("folder", "is a folder; a file is expected here");
    refused("fifo", "is not a regular file");
}

TEST_CASE("SHA-256 and FNV-1a of the published test vectors") {
    // FIPS 180-2, appendix B, and NIST's SHA256ShortMsg for the empty message.
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const std::string bytes(1'000'000, 'a');
    const std::string sum = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
    CHECK(sha256(bytes) == sum);
    const TemporaryFolder temporary;
    write_file(temporary.path / "a", bytes);  // it is read in pieces
    CHECK(sha256_of_file(temporary.path / "a") == sum);
    CHECK_THROWS_AS(sha256_of_file(temporary.path / "none"), std::system_error);
    CHECK_THROWS_AS(sha256_of_file(temporary.path), std::system_error);
    CHECK(fnv1a_128("") == "6c62272e07bb014262b821756295c58d");
    CHECK(fnv1a_128("a") == "d228cb696f1a8caf78912b704e4a8964");
}
