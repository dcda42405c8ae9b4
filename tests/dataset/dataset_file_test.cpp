#include "output/dataset/dataset_file.h"

#include <tuple>

#include "output/dataset/metadata.h"
#include "run/job/dataset_folders.h"
#include "support/small_mission.h"

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
    static const Json values = Json::parse(R"([null, true, false, 0, 1, -1, 1.5, 1e300, -1e300,
        18446744073709551615, "", ".", "..", "../victim", "/etc/passwd", "front/../../%06d.json",
        "front/%06d/%06d.json", "%s%n", "javascript:alert(1)//%06d", "C:\\%06d", "front/a\u0000b",
        "front/polar/%d.npy", [], {}, [1, "a"], {"file": "../x"}])");
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

}  // namespace

TEST_CASE("dataset file: names that stay below their folder") {
    for (const char* name : {"fls", "000001.npy", "a-b_c.1+2", "_"})
        CHECK_MESSAGE(is_plain_name(name), name);
    const std::vector<std::string> none{"",    ".",        "..", ".part",
                                        "a/b", "a\\b",     "C:", "a b",
                                        "a\n", "\xc3\xa9", "%",  std::string("a\0b", 3)};
    for (const std::string& name : none)
        CHECK_FALSE_MESSAGE(is_plain_name(name), name);
    CHECK(numbered("fls/polar/%06d.npy", 7) == "fls/polar/000007.npy");
    CHECK(numbered("fls/polar/%06d.npy", 12345678) == "fls/polar/12345678.npy");
    CHECK(numbered("fls-%09d.png", 0) == "fls-000000000.png");
}

// cli/test_verify.py has what is refused by every command.
TEST_CASE_FIXTURE(
    MissionInFolder,
    "dataset file: sound keys are read, paths that are not the sensor's own are refused") {
    run(mission);
    const Json sound = read_json(out / "dataset.json");
    const DatasetFile dataset = parse_description(sound, "dataset.json");
    CHECK(dataset.complete);
    CHECK(dataset.poses == poses);
    REQUIRE(dataset.sensors.size() == 2);
    CHECK(dataset.sensors[1].every == 3);
    CHECK(dataset.sensors[1].pings == 3);
    for (const auto& [pointer, value, words] :
         {std::tuple("/sensors/1/name", "front", "not the path of a file in 'front/'"),
          {"/sensors/0/files/meta", "left/meta/%06d.json", "not the path of a file in 'front/'"},
          {"/sensors/0/files/meta", "front/%06d-%06d.json", "not the path of a file"},
          {"/sensors/0/files/meta", "front/%d.json", "without a number as '%06d'"}}) {
        Json json = sound;
        json[Json::json_pointer(pointer)] = value;
        CHECK_THROWS_WITH_AS(parse_description(json, "a/dataset.json"), doctest::Contains(words),
                             InputError);
    }
    Json lacks = sound;
    lacks["sensors"][0].erase("every");
    CHECK_THROWS_WITH_AS(
        parse_description(lacks, "d"),
        "d: is damaged: key 'every' not found; copy the dataset again, or render it again",
        InputError);
}

// Whatever stands in dataset.json, commands refuse it or work, and no file beside it changes.
TEST_CASE_FIXTURE(MissionInFolder,
                  "dataset file: a sound one changed at random is refused or read") {
    run(mission);
    std::filesystem::create_directory(temporary.path / "victim");
    write_file(temporary.path / "victim/dataset.json", "kept");
    const Json sound = read_json(out / "dataset.json");
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
            const DatasetFile dataset = parse_description(json, "dataset.json");
            for (const std::string& name : list_files(dataset)) {
                const std::filesystem::path path(name);
                const bool inside =
                    path.is_relative() && std::ranges::find(path, "..") == path.end();
                CHECK_MESSAGE(inside, name);
            }
        });
        if (k % 20 != 0) continue;  // the commands take longer
        write_file(out / "dataset.json", json_text(json));
        const std::atomic<bool> go(false);
        expect_input_error("verify", json, [&] { verify_folder(out, 1, nullptr, go); });
        expect_input_error("status", json, [&] { read_status({out}); });
        const std::filesystem::path merged = temporary.path / "merged";
        expect_input_error("merge", json, [&] { merge_parts({out}, merged, {}, go); });
        expect_input_error("render", json, [&] { run(mission); });
        std::filesystem::remove_all(merged);
        CHECK(read_file(temporary.path / "victim/dataset.json", 100) == "kept");
    }
}
