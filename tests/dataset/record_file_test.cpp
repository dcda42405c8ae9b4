#include "output/dataset/record_file.h"

#include <thread>

#include "support/npy_data.h"

namespace {

template <class T>
std::span<const std::byte> bytes(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

}  // namespace

TEST_CASE("records: written in any order by any thread, they read back; the rest is zero") {
    const TemporaryFolder folder;
    const auto path = folder.path / "sss" / "waterfall.npy";
    const NpyFormat format{"<f4", {50, 40}};
    {
        const RecordFile file(path, format, 50);
        CHECK(file.record_bytes() == 160);
        // It can be opened at once, as long as it will ever be.
        CHECK(data_of<float>(path, format) == std::vector<float>(2000, 0.0F));
        const auto fill = [&](int first) {
            for (int k = 49 - first; k >= 0; k -= 2) {
                if (k == 7) continue;
                file.write(k, bytes(std::vector<float>(40, static_cast<float>(k + 1))));
            }
        };
        std::thread other([&] { fill(0); });
        fill(1);
        other.join();
        const std::vector<float> seven(40, 7.0F);
        CHECK(file.hash(6) == hash_of_record(record_bytes(seven)));
        CHECK(file.hash(7) == hash_of_record(std::string(160, '\0')));
        CHECK(file.hash(6) != file.hash(7));
        CHECK_THROWS_AS(file.write(50, bytes(std::vector<float>(40))), std::logic_error);
        CHECK_THROWS_AS(file.write(0, bytes(std::vector<float>(39))), std::logic_error);
    }
    const std::vector<float> values = data_of<float>(path, format);
    for (std::size_t k = 0; k < 50; ++k) {
        CHECK(values[k * 40] == (k == 7 ? 0.0F : static_cast<float>(k + 1)));
        CHECK(values[k * 40 + 39] == values[k * 40]);
    }
    // Opened again, it keeps what it holds.
    const std::string before = read_file(path, 1 << 20);
    const RecordFile again(path, format, 50);
    CHECK(read_file(path, 1 << 20) == before);
    std::vector<float> record(40);
    again.read(3, std::as_writable_bytes(std::span(record)));
    CHECK(record == std::vector<float>(40, 4.0F));
}

TEST_CASE("records: a file that a crash left short is made whole") {
    const TemporaryFolder folder;
    const auto path = folder.path / "a.npy";
    write_file(path, "half a header");
    const RecordFile file(path, {"<f4", {3, 4}}, 3);
    CHECK(data_of<float>(path, {"<f4", {3, 4}}) == std::vector<float>(12, 0.0F));
}

TEST_CASE("records: a link in the file's place is not followed") {
    const TemporaryFolder folder;
    write_file(folder.path / "other", "somebody's");
    std::filesystem::create_symlink(folder.path / "other", folder.path / "a.npy");
    CHECK_THROWS_AS(RecordFile(folder.path / "a.npy", {"<f4", {1, 1}}, 1), std::system_error);
    CHECK(read_file(folder.path / "other", 100) == "somebody's");
}
