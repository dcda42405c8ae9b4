#include "run/job/ping_source.h"

#include <doctest/doctest.h>

#include <set>

#include "core/file.h"
#include "job/small_job.h"
#include "output/dataset/encode_ping.h"
#include "output/dataset/layout.h"
#include "simulate/assembly/engines.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The numbers of an array as the bytes of its file.
std::string file_of(const PingNumbers& numbers) {
    REQUIRE(numbers.shape.size() == 2);
    return npy_bytes(std::get<std::vector<float>>(numbers.values), numbers.shape[0],
                     numbers.shape[1]);
}

}  // namespace

TEST_SUITE("job") {
    TEST_CASE("job: a ping in memory has the numbers of the files") {
        const TemporaryFolder folder;
        Mission mission = survey_mission(folder.path / "out");
        mission.output.labels = {Label::instance, Label::elevation, Label::clean, Label::objects};
        const Assembly assembly = small_assembly(mission, poses);
        run_job(mission, assembly, {}, {}, std::atomic<bool>(false));
        const PingSource source(mission, assembly);
        const std::vector<Writers> writers = make_writers(mission, assembly);
        const Layout layout = make_layout(mission, writers, assembly.trajectory.size());
        const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
        const auto content = [&](const PingId& id, const char* name, const char* extension) {
            return read_file(layout.file(id, {name, extension}), 1 << 24);
        };
        std::set<std::string> compared;
        for (const PingId& id : list_pings(mission, assembly.trajectory.size())) {
            const PingInMemory ping = source.ping(id);
            CAPTURE(id.pose);
            CAPTURE(id.sensor);
            CHECK(ping.metadata == content(id, "meta", ".json"));
            const bool has_images = kind_of(mission.sensors[id.sensor].kind).has_images;
            if (has_images) {
                const Ping alone = render_ping(assembly.sonars[id.sensor], assembly.scene, *engine,
                                               assembly.trajectory[id.pose].T_world_vehicle,
                                               {mission.seed, id.pose});
                CHECK(std::get<std::vector<float>>(ping.image.values) == alone.intensity);
                CHECK(file_of(ping.image) == content(id, "polar", ".npy"));
            }
            for (const PingInMemory::Array& array : ping.arrays) {
                if (!has_images ||
                    !std::holds_alternative<std::vector<float>>(array.numbers.values))
                    continue;
                CHECK(file_of(array.numbers) == content(id, array.name.c_str(), ".npy"));
                compared.insert(array.name);
            }
            for (const PingInMemory::Text& text : ping.texts) {
                CHECK(text.text == content(id, text.name.c_str(), text.extension.c_str()));
                compared.insert(text.name);
            }
        }
        CHECK(compared ==
              std::set<std::string>{"clean", "elevation", "elevation_spread", "objects"});
        const auto sensors = source.describe().at("sensors");
        CHECK(sensors ==
              nlohmann::ordered_json::parse(read_file(folder.path / "out/dataset.json", 1 << 20))
                  .at("sensors"));
    }
}
