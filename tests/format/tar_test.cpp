#include "format/tar.h"

#include <doctest/doctest.h>

#include <map>
#include <stdexcept>

#include "core/file.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;

namespace {

std::map<std::string, std::string> read_back(const std::string& archive) {
    const TemporaryFolder temporary;
    const auto path = temporary.path / "a.tar";
    write_file(path, archive);
    std::map<std::string, std::string> files;
    for_each_in_tar(
        path, [&](const std::string& name, const std::string& bytes) { files[name] = bytes; });
    return files;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("tar: a header by POSIX") {
        std::string archive;
        append_to_tar(archive, "a.txt", "hello");
        CHECK(archive.size() == 1024);
        CHECK(archive.substr(0, 6) == std::string("a.txt\0", 6));
        CHECK(archive.substr(100, 8) == std::string("0000644\0", 8));
        CHECK(archive.substr(124, 12) == std::string("00000000005\0", 12));
        CHECK(archive.substr(136, 12) == std::string("00000000000\0", 12));
        CHECK(archive.substr(156, 1) == "0");
        CHECK(archive.substr(257, 8) == std::string("ustar\00000", 8));
        // The bytes of the header: the name 97+46+116+120+116 = 495; mode 4 zeros and 6 4 4 are
        // 4*48+54+52+52 = 350; owner and group 7 zeros each are 672; size 10 zeros and a 5 are 533,
        // time 11 zeros are 528; the type 48; "ustar" 559 and its version 96; the sum as 8 blanks
        // 256. Together 3537, in octal 6721.
        CHECK(archive.substr(148, 8) == std::string("006721\0 ", 8));
        CHECK(archive.substr(512, 6) == std::string("hello\0", 6));
    }

    TEST_CASE("tar: what is written is read back, at every length about a block") {
        std::string archive;
        std::map<std::string, std::string> files;
        for (const std::size_t bytes : {0, 1, 511, 512, 513, 1024, 5000}) {
            const std::string name = "f" + std::to_string(bytes);
            files[name] = std::string(bytes, 'x');
            const std::size_t before = archive.size();
            append_to_tar(archive, name, files[name]);
            CHECK(archive.size() - before == tar_bytes(bytes));
        }
        archive.append(tar_end_bytes, '\0');
        CHECK(read_back(archive) == files);
        CHECK(tar_bytes(~std::uint64_t{0}) == 512 + (std::uint64_t{1} << 33));
    }

    TEST_CASE("tar: a file that is no archive of ours is refused") {
        std::string archive;
        append_to_tar(archive, "a", std::string(700, 'x'));
        const std::string end(tar_end_bytes, '\0');
        CHECK_THROWS_WITH(read_back(archive), "is cut off");
        CHECK_THROWS_WITH(read_back(archive.substr(0, 1000)), "is cut off");
        CHECK_THROWS_WITH(read_back(archive + end + end), "has bytes after its end");
        std::string other_time = archive + end;
        other_time[146] = '1';
        CHECK_THROWS_WITH(read_back(other_time), "is no archive of ours");
        CHECK_THROWS_WITH(read_back(std::string(1024, 'x')), "is no tar archive");
        CHECK_THROWS_AS(append_to_tar(archive, std::string(101, 'n'), ""), std::logic_error);
    }
}
