#include "dataset/dataset_file.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "core/error.h"
#include "dataset/checked_json.h"
#include "dataset/description.h"
#include "dataset/file_names.h"
#include "dataset/ping_metadata.h"
#include "job/merge.h"
#include "job/small_job.h"
#include "job/status.h"
#include "job/verify.h"

using namespace sonarsim;
using namespace sonarsim::test;
using Json = nlohmann::ordered_json;

namespace {

/// Every value of a tree, the tree itself included.
void list_values(Json& json, std::vector<Json*>& values) {
    values.push_back(&json);
    if (!json.is_structured()) return;
    for (Json& inner : json)
        list_values(inner, values);
}

/// Values that somebody might put in place of another.
Json foreign_value(std::mt19937_64& random) {
    static const std::vector<Json> values{nullptr,
                                          true,
                                          false,
                                          0,
                                          1,
                                          -1,
                                          1.5,
                                          1e300,
                                          -1e300,
                                          18446744073709551615U,
                                          "",
                                          ".",
                                          "..",
                                          "../victim",
                                          "/etc/passwd",
                                          "front/../../%06d.json",
                                          "front/%06d/%06d.json",
                                          "%s%n",
                                          "javascript:alert(1)//%06d",
                                          "C:\\%06d",
                                          std::string("front/a\0b", 9),
                                          "front/polar/%d.npy",
                                          Json::array(),
                                          Json::object(),
                                          Json::array({1, "a"}),
                                          Json{{"file", "../x"}}};
    return values[random() % values.size()];
}

/// Calls `use`, which may refuse its input, and nothing else may go wrong with it.
template <class Use>
void expect_input_error(const char* what, const Json& json, const Use& use) {
    try {
        use();
    } catch (const InputError& error) {
        const std::string message = error.what();
        INFO(what << ": " << message << "\n" << json.dump());
        CHECK(message.find("json.exception") == std::string::npos);
    } catch (const std::exception& error) {
        FAIL(what << ": " << error.what() << "\n" << json.dump());
    }
}

Json sound_description(const std::filesystem::path& folder) {
    return read_json(folder / "dataset.json", 1 << 20);
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("dataset file: names and patterns that stay below their folder") {
        for (const char* name : {"fls", "000001.npy", "a-b_c.1+2", "_"})
            CHECK_MESSAGE(is_plain_name(name), name);
        const std::vector<std::string> none{"",    ".",        "..", ".part",
                                            "a/b", "a\\b",     "C:", "a b",
                                            "a\n", "\xc3\xa9", "%",  std::string("a\0b", 3)};
        for (const std::string& name : none)
            CHECK_FALSE_MESSAGE(is_plain_name(name), name);
        CHECK(is_inner_path("fls/polar/000001.npy"));
        for (const char* path : {"/fls", "fls/", "fls//a", "fls/../a", "./fls", "..", "http://a/b"})
            CHECK_FALSE_MESSAGE(is_inner_path(path), path);
        CHECK(numbered("fls/polar/%06d.npy", 7) == "fls/polar/000007.npy");
        CHECK(numbered("fls/polar/%06d.npy", 12345678) == "fls/polar/12345678.npy");
        CHECK(numbered("fls-%09d.png", 0) == "fls-000000000.png");
        for (const char* pattern :
             {"fls/polar/7.npy", "fls/%06d/7.npy", "fls/%06d-%06d.npy", "fls/%d.npy", "fls/%6d.npy",
              "fls/%00d.npy", "fls/%06s.npy", "fls/%06", "../%06d.npy", "/%06d", "a:%06d", "%%06d"})
            CHECK_MESSAGE(numbered(pattern, 7).empty(), pattern);
    }

    TEST_CASE("dataset file: sound keys are read, and each error names its key") {
        const TemporaryFolder folder;
        run(small_mission(folder.path / "out"));
        const Json sound = sound_description(folder.path / "out");
        const DatasetFile dataset = check_description(sound, "dataset.json");
        CHECK(dataset.complete);
        CHECK(dataset.poses == poses);
        REQUIRE(dataset.sensors.size() == 2);
        CHECK(dataset.sensors[1].every == 3);
        CHECK(dataset.sensors[1].pings == 3);
        struct Case {
            const char* pointer;
            Json value;
            const char* words;
        };
        const Case cases[] = {
            {"/complete", "true", "'complete' is \"true\" and must be true or false"},
            {"/mission", "../victim", "'mission' is \"../victim\" and must be fit for the name"},
            {"/poses", -7, "'poses' is -7 and must be a whole number from 1 to"},
            {"/poses", 1e18, "'poses'"},
            {"/seed", "7", "'seed'"},
            {"/format_version", 2, "has format_version 2, and this program knows 3"},
            {"/sensors", 5, "'sensors' is 5 and must be an array"},
            {"/sensors/1/name", "../a", "'sensors[1].name'"},
            {"/sensors/1/name", "front", "a file in 'front/'"},
            {"/sensors/1/every", 0, "'sensors[1].every' is 0 and must be a whole number from 1"},
            {"/sensors/1/pings", 4, "'sensors[1].pings' is 4 and must be a whole number from 3"},
            {"/sensors/0/files/meta", "../x/%06d.json", "'sensors[0].files.meta'"},
            {"/sensors/0/files/meta", "left/meta/%06d.json", "a file in 'front/'"},
            {"/sensors/0/files/meta", "javascript:%06d", "with one number as '%06d'"},
            {"/sensors/0/range_edges_m/1", "1", "'sensors[0].range_edges_m[1]'"},
            {"/products", {"../x"}, "'products[0]'"},
        };
        for (const Case& one : cases) {
            CAPTURE(one.pointer);
            Json json = sound;
            json[Json::json_pointer(one.pointer)] = one.value;
            try {
                check_description(json, "a/dataset.json");
                FAIL("it was taken");
            } catch (const InputError& error) {
                const std::string message = error.what();
                CHECK_MESSAGE(message.starts_with("a/dataset.json: "), message);
                CHECK_MESSAGE(message.find(one.words) != std::string::npos, message);
            }
        }
        Json lacks = sound;
        lacks["sensors"][0].erase("every");
        CHECK_THROWS_WITH_AS(
            check_description(lacks, "d"),
            "d: lacks 'sensors[0].every'; copy the dataset again, or render it anew", InputError);
        const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
        CHECK_THROWS_AS(parse_json(deep, "d"), InputError);
    }

    // Whatever stands in dataset.json, each command refuses it with a sentence or does its work,
    // and no file next to the dataset changes.
    TEST_CASE("dataset file: a sound one changed at random is refused or read") {
        const TemporaryFolder folder;
        const std::filesystem::path out = folder.path / "out";
        Mission mission = small_mission(out);
        run(mission);
        std::filesystem::create_directory(folder.path / "victim");
        write_file(folder.path / "victim/dataset.json", "kept");
        const Json sound = sound_description(out);
        std::mt19937_64 random(25);
        for (int k = 0; k < 800; ++k) {
            Json json = sound;
            for (std::uint64_t change = random() % 3 + 1; change > 0; --change) {
                std::vector<Json*> values;
                list_values(json, values);
                Json& value = *values[random() % values.size()];
                const bool gone = value.is_structured() && !value.empty() && random() % 4 == 0;
                gone ? void(value.erase(value.begin())) : void(value = foreign_value(random));
            }
            expect_input_error("reader", json, [&] {
                const DatasetFile dataset = check_description(json, "dataset.json");
                for_each_described(dataset, [](const DescribedFile& file) {
                    CHECK_MESSAGE(is_inner_path(file.name), file.name);
                    return true;
                });
            });
            if (k % 20 != 0) continue;  // the commands take longer
            write_file(out / "dataset.json", json_text(json));
            const std::atomic<bool> go(false);
            expect_input_error("verify", json, [&] { verify_dataset(out, 1, nullptr, go); });
            expect_input_error("status", json, [&] { read_status({out}); });
            const std::filesystem::path merged = folder.path / "merged";
            expect_input_error("merge", json, [&] { merge_datasets({out}, merged, 1, {}, go); });
            expect_input_error("render", json, [&] { run(mission); });
            std::filesystem::remove_all(merged);
            CHECK(read_file(folder.path / "victim/dataset.json", 100) == "kept");
        }
    }
}
