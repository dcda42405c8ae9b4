#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "core/file.h"
#include "dataset/coco/coco.h"
#include "dataset/writer.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;

TEST_SUITE("dataset") {
    TEST_CASE("coco of records: rows that stand for two pings each") {
        // 100,001 pings make 50,001 rows of 2. An object is in bin 3 of the pings 10 to 20 and of
        // ping 50,001, which is the second one of row 25,000.
        constexpr std::size_t pings = 100'001;
        constexpr std::size_t bins = 4;
        const TemporaryFolder folder;
        const NpyFormat format{"<u2", {pings, bins}};
        const PingRecord record{"instance.npy", format, {"ping", "column"}, "instance"};
        {
            const RecordFile file(folder.path / "sss" / record.file, format, pings);
            const std::vector<std::uint16_t> seen{0, 0, 0, 7};
            for (std::size_t ping = 10; ping <= 20; ++ping)
                file.write(ping, std::as_bytes(std::span(seen)));
            file.write(50'001, std::as_bytes(std::span(seen)));
        }
        Layout layout;
        layout.folder = folder.path;
        layout.poses = pings;
        layout.sensors.push_back(
            {.name = "sss", .pings = pings, .per_ping = {record}, .products = {"rows.png"}});
        nlohmann::ordered_json description = {{"mission", "m"}, {"program_version", "1"}};
        description["sensors"] = {
            {{"name", "sss"},
             {"range_edges_m", {1, 2, 3, 4, 5}},
             {"pictures",
              {{{"file", "sss/view.png"}, {"per", "sensor"}, {"boxes_of", "sss/rows.png"}}}}}};
        description["labels"]["classes"] = {{{"id", 1}, {"name", "mine"}}};
        for (int k = 0; k < 7; ++k)
            description["labels"]["instances"].push_back({{"class", 1}});
        write_record_coco(
            layout, description,
            {SharedProduct::Kind::coco, "coco.json", CocoPicture::record, SplitPart::none});
        const auto coco =
            nlohmann::json::parse(read_file(folder.path / "coco.json", std::size_t{1} << 20));
        REQUIRE(coco["images"].size() == 1);
        CHECK(coco["images"][0]["file_name"] == "sss/rows.png");
        CHECK(coco["images"][0]["width"] == bins);
        CHECK(coco["images"][0]["height"] == 50'001);
        REQUIRE(coco["annotations"].size() == 2);
        // Rows 5 (pings 10 and 11) to 10 (ping 20).
        CHECK(coco["annotations"][0]["bbox"] == nlohmann::json({3, 5, 1, 6}));
        CHECK(coco["annotations"][0]["area"] == 6);
        CHECK(coco["annotations"][1]["bbox"] == nlohmann::json({3, 25'000, 1, 1}));
        for (const auto& one : coco["annotations"]) {
            CHECK(one["instance_id"] == 7);
            CHECK(one["segmentation"]["size"] == nlohmann::json({50'001, bins}));
        }
    }

    TEST_CASE("coco of records: range and shadow of a pass of more than a thousand pings") {
        // A pipe comes nearer, from bin 2 to bin 0, and has its shadow at the end alone.
        constexpr std::size_t pings = 3000;
        constexpr std::size_t bins = 4;
        const TemporaryFolder folder;
        const NpyFormat format{"<u2", {pings, bins}};
        const std::vector<std::string> axes{"ping", "column"};
        const PingRecord ids{"instance.npy", format, axes, "instance"};
        const PingRecord shadows{"shadow.npy", format, axes, object_shadow_record};
        {
            const RecordFile instance(folder.path / "sss" / ids.file, format, pings);
            const RecordFile shadow(folder.path / "sss" / shadows.file, format, pings);
            for (std::size_t ping = 0; ping < pings; ++ping) {
                std::vector<std::uint16_t> row(bins);
                row[ping < pings / 2 ? 2 : 0] = 1;
                instance.write(ping, std::as_bytes(std::span(row)));
                row = {0, ping < 2500 ? std::uint16_t{0} : std::uint16_t{1}, 0, 0};
                shadow.write(ping, std::as_bytes(std::span(row)));
            }
        }
        Layout layout;
        layout.folder = folder.path;
        layout.poses = pings;
        layout.sensors.push_back(
            {.name = "sss", .pings = pings, .per_ping = {ids, shadows}, .products = {"rows.png"}});
        nlohmann::ordered_json description = {{"mission", "m"}, {"program_version", "1"}};
        description["sensors"] = {
            {{"name", "sss"},
             {"range_edges_m", {1, 2, 3, 4, 5}},
             {"pictures",
              {{{"file", "sss/view.png"}, {"per", "sensor"}, {"boxes_of", "sss/rows.png"}}}}}};
        description["labels"]["classes"] = {{{"id", 1}, {"name", "pipe"}}};
        description["labels"]["instances"].push_back({{"class", 1}});
        write_record_coco(
            layout, description,
            {SharedProduct::Kind::coco, "coco.json", CocoPicture::record, SplitPart::none});
        const auto coco =
            nlohmann::json::parse(read_file(folder.path / "coco.json", std::size_t{1} << 20));
        REQUIRE(coco["annotations"].size() == 1);
        CHECK(coco["annotations"][0]["bbox"] == nlohmann::json({0, 0, 3, pings}));
        CHECK(coco["annotations"][0]["range_m"] == 2.5);
        CHECK(coco["annotations"][0]["shadow_bbox"] == nlohmann::json({1, 2500, 1, 500}));
    }
}
