#include "core/file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <system_error>

#include "core/error.h"

using namespace sonarsim;
namespace fs = std::filesystem;

namespace {

/// A temporary folder that the destructor removes.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "sonarsim_file_XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    fs::path operator/(const char* name) const { return path_ / name; }
    auto entries() const {
        return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
    }

  private:
    fs::path path_;
};

/// Limits the size of files to `bytes` during its lifetime, as a full disk would.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

std::string message_of_reading(const fs::path& path, std::size_t limit = 1000) {
    try {
        read_file(path, limit);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_SUITE("core") {
    TEST_CASE("file: written bytes are read back, zero bytes included") {
        const Folder folder;
        const std::string bytes("a\0b\r\n\xff", 6);
        write_file(folder / "a.bin", bytes);
        CHECK(read_file(folder / "a.bin", 6) == bytes);
        write_file(folder / "a.bin", "");
        CHECK(read_file(folder / "a.bin", 6) == "");
        CHECK(folder.entries() == 1);
    }

    TEST_CASE("file: a temporary name is a hidden sibling, another one each time") {
        const fs::path one = temporary_name("out/a.png");
        CHECK(one.parent_path() == "out");
        CHECK(one.filename().string().starts_with(".a.png."));
        CHECK(is_temporary_name(one.filename().string()));
        CHECK(final_name(one.filename().string()) == "a.png");
        CHECK(temporary_name("out/a.png") != one);
        CHECK(temporary_name("a.png").parent_path().empty());
        CHECK_FALSE(is_temporary_name("a.png"));
        CHECK_FALSE(is_temporary_name("a.part"));
        // Names of other programs' files.
        for (const char* name : {".part", ".a.mkv.part", ".a.mkv.0123456789ABCDEF.part",
                                 ".a.mkv.0123456789abcde.part", ".0123456789abcdef.part"})
            CHECK_FALSE(is_temporary_name(name));
        CHECK(is_temporary_name(".a.mkv.0123456789abcdef.part"));
        CHECK(final_name("a.png") == "a.png");
    }

    TEST_CASE("file: reading refuses what is missing, too long or no regular file") {
        const Folder folder;
        const fs::path path = folder / "a.txt";
        CHECK(message_of_reading(path) ==
              path.string() + ": cannot open: No such file or directory");

        write_file(path, "12345");
        CHECK(message_of_reading(path, 5) == "");
        CHECK(message_of_reading(path, 4) ==
              path.string() + ": is 5 bytes long; at most 4 are read");

        const fs::path subfolder = folder / "folder";
        fs::create_directory(subfolder);
        CHECK(message_of_reading(subfolder) ==
              subfolder.string() + ": is a folder; a file is expected here");

        // Nobody writes to this one: an ordinary open() would wait for ever.
        const fs::path fifo = folder / "fifo";
        REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
        CHECK(message_of_reading(fifo) == fifo.string() + ": is not a regular file");
    }

    TEST_CASE("file: a write that the disk refuses leaves the old file and nothing else") {
        const Folder folder;
        write_file(folder / "a.txt", "old");
        {
            const FileSizeLimit full(4096);
            CHECK_THROWS_AS(write_file(folder / "a.txt", std::string(10000, 'x')),
                            std::system_error);
        }
        CHECK(read_file(folder / "a.txt", 100) == "old");
        CHECK(folder.entries() == 1);
    }

    TEST_CASE("file: a rename that fails leaves no temporary file") {
        const Folder folder;
        fs::create_directory(folder / "taken");
        try {
            write_file(folder / "taken", "x");
            FAIL("a folder was overwritten");
        } catch (const std::system_error& error) {
            CHECK(error.code() == std::errc::is_a_directory);
            CHECK(std::string(error.what()).find("taken") != std::string::npos);
        }
        CHECK(folder.entries() == 1);
    }

    TEST_CASE("file: a missing folder is an error with the reason") {
        const Folder folder;
        try {
            write_file(folder / "no/a.txt", "x");
            FAIL("wrote into a folder that is not there");
        } catch (const std::system_error& error) {
            CHECK(error.code() == std::errc::no_such_file_or_directory);
        }
        CHECK(folder.entries() == 0);
    }
}
