#include <doctest/doctest.h>

#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "job/journal.h"
#include "job/run_job.h"
#include "job/small_job.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

namespace {

/// Renders until `count` pings are done, then asks to stop.
RenderSummary run_until(const Mission& mission, std::uint64_t count) {
    std::atomic<bool> stop = false;
    const auto progress = [&](const RenderSummary& so_far, std::uint64_t) {
        stop = so_far.pings >= count;
    };
    return run_job(mission, small_assembly(mission, poses), {.threads = 1}, progress, stop);
}

}  // namespace

TEST_SUITE("job") {
    TEST_CASE("job: progress counts up to the total") {
        const TemporaryFolder temporary;
        const Mission mission = small_mission(temporary.path / "out");
        std::vector<std::uint64_t> seen;
        run_job(
            mission, small_assembly(mission, poses), {.threads = 3},
            [&](const RenderSummary& so_far, std::uint64_t total) {
                CHECK(total == pings);
                seen.push_back(so_far.pings);
            },
            std::atomic<bool>(false));
        CHECK(seen == std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    }

    TEST_CASE("job: the bytes depend neither on threads nor on interruptions") {
        const auto whole = whole_dataset();
        const TemporaryFolder temporary;
        for (const int threads : {1, 2, 5}) {
            const fs::path out = temporary.path / std::to_string(threads);
            run(small_mission(out), {.threads = threads});
            CHECK(contents(out) == whole);
        }
        const fs::path out = temporary.path / "interrupted";
        const Mission mission = small_mission(out);
        const RenderSummary first = run_until(mission, 4);
        CHECK(first.stopped);
        CHECK_FALSE(first.complete);
        CHECK(first.pings >= 4);
        CHECK(first.pings < pings);
        CHECK_FALSE(is_complete(out));
        CHECK(contents(out).size() == 4 + first.pings * 4);
        const RenderSummary second = run(mission);
        CHECK(second.skipped == first.pings);
        CHECK(second.pings == pings - first.pings);
        CHECK(second.complete);
        CHECK(contents(out) == whole);
    }

    TEST_CASE("job: a stop before the first ping leaves a folder that can be resumed") {
        const TemporaryFolder temporary;
        const Mission mission = small_mission(temporary.path / "out");
        const RenderSummary none =
            run_job(mission, small_assembly(mission, poses), {}, {}, std::atomic<bool>(true));
        CHECK(none.stopped);
        CHECK(none.pings == 0);
        CHECK_FALSE(is_complete(temporary.path / "out"));
        CHECK(run(mission).complete);
        CHECK(contents(temporary.path / "out") == whole_dataset());
    }

    TEST_CASE("job: what a crash left behind is put right") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run_until(mission, 6);
        fs::remove(out / "front/polar/000001.npy");
        write_file(out / "front/polar/.000001.npy.0123456789abcdef.part", "half");
        write_file(out / "left/meta/.000006.json.0123456789abcdef.part", "half");
        write_file(out / ".dataset.json.0123456789abcdef.part", "half");
        CHECK(run(mission).complete);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: a finished dataset is left alone, a gap in it is filled") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run(mission);
        const auto before = fs::last_write_time(out / "dataset.json");
        const RenderSummary again = run(mission);
        CHECK(again.pings == 0);
        CHECK(again.skipped == pings);
        CHECK(again.complete);
        CHECK(fs::last_write_time(out / "dataset.json") == before);

        fs::remove(out / "left/fan/000003.png");
        const RenderSummary filled = run(mission);
        CHECK(filled.pings == 1);
        CHECK(filled.complete);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: a ping that saw nothing is there like any other") {
        // Straight up out of the tank: without noise every record is zero.
        const TemporaryFolder temporary;
        Mission mission = survey_mission(temporary.path / "out");
        mission.sensors = {mission.sensors[2], mission.sensors[3]};
        for (SonarConfig& sensor : mission.sensors) {
            sensor.noise = {};
            sensor.mount.rpy_deg = {180.0, 0.0, 0.0};
            sensor.azimuth_deg = 20.0;
        }
        CHECK(run(mission).complete);
        const RenderSummary again = run(mission);
        CHECK(again.counts.echoes == 0);
        CHECK(again.pings == 0);
        CHECK(again.complete);
        const Mission shards = [&] {
            Mission other = mission;
            other.output.folder = temporary.path / "shards";
            return other;
        }();
        CHECK_FALSE(run(shards, {.shard = 0, .shards = 2}).complete);
        CHECK(run(shards, {.shard = 1, .shards = 2}).complete);
    }

    TEST_CASE("job: a file that goes away during the run is no part of a complete dataset") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        const auto thief = [&](const RenderSummary& so_far, std::uint64_t total) {
            if (so_far.pings == total) fs::remove(out / "front/polar/000000.npy");
        };
        CHECK_THROWS_AS(
            run_job(mission, small_assembly(mission, poses), {}, thief, std::atomic<bool>(false)),
            std::runtime_error);
        CHECK_FALSE(is_complete(out));
        CHECK(run(mission).pings == 1);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: records that go away during the run are no part of a complete dataset") {
        const TemporaryFolder temporary;
        const Mission mission = survey_mission(temporary.path / "out");
        const fs::path file = mission.output.folder / "mbes/soundings.npy";
        for (const bool replaced : {false, true}) {
            fs::remove_all(mission.output.folder);
            const auto thief = [&](const RenderSummary& so_far, std::uint64_t) {
                if (so_far.pings != 1) return;
                if (replaced) fs::copy_file(file, temporary.path / "copy");
                fs::remove(file);
                if (replaced) fs::rename(temporary.path / "copy", file);
            };
            CHECK_THROWS_AS(run_job(mission, small_assembly(mission, poses), {}, thief,
                                    std::atomic<bool>(false)),
                            std::runtime_error);
            CHECK_FALSE(is_complete(mission.output.folder));
            CHECK(run(mission).complete);
            CHECK(fs::exists(file));
        }
    }

    TEST_CASE("job: a sensor may be called journal") {
        const TemporaryFolder temporary;
        Mission mission = small_mission(temporary.path / "out");
        mission.sensors[0].name = "journal";
        CHECK(run(mission).complete);
        CHECK(fs::exists(mission.output.folder / "journal/polar/000000.npy"));
        CHECK(run(mission).pings == 0);
    }

    TEST_CASE("job: common files that went away are written again") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run(mission);
        fs::remove(out / "mission.resolved.yaml");
        fs::remove(out / "trajectory.tum");
        const RenderSummary again = run(mission);
        CHECK(again.pings == 0);
        CHECK(again.complete);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: a file of another size than the journal's is rendered again") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run(mission);
        write_file(out / "front/fan/000002.png", "");
        write_file(out / "left/meta/000003.json", "{}");
        CHECK(run(mission).pings == 2);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: lines of the journal that are torn or made up do not count") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run_until(mission, 4);
        const fs::path part = out / "journal.d/1-of-1.txt";
        const std::string lines = read_file(part, 1 << 20);
        write_file(part, lines.substr(0, lines.size() - 3) + "\nping 0 6 1 1 1 1 00000000\nping\n");
        const RenderSummary rest = run(mission);
        CHECK(rest.complete);
        CHECK(rest.skipped > 0);
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: options that make no sense are refused") {
        const TemporaryFolder temporary;
        const Mission mission = small_mission(temporary.path / "out");
        CHECK_THROWS_AS(run(mission, {.threads = -1}), InputError);
        CHECK_THROWS_AS(run(mission, {.shard = 2, .shards = 2}), InputError);
        CHECK_THROWS_AS(run(mission, {.shard = -1, .shards = 2}), InputError);
        CHECK_THROWS_AS(run(mission, {.shard = 0, .shards = 0}), InputError);
        CHECK_THROWS_AS(run(mission, {.shard = 0, .shards = 2, .overwrite = true}), InputError);
        CHECK_FALSE(fs::exists(temporary.path / "out"));
    }

    TEST_CASE("job: a file that cannot be written ends the run with the reason") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        run_until(mission, 1);
        fs::create_directories(out / "front/fan/000006.png");  // a folder bears the file's name
        CHECK_THROWS_AS(run(mission), std::system_error);
        CHECK_FALSE(is_complete(out));
        for (const auto& [name, bytes] : contents(out)) {
            CHECK(name.find(".part") == std::string::npos);
        }
        fs::remove(out / "front/fan/000006.png");
        CHECK(run(mission).complete);
        CHECK(contents(out) == whole_dataset());
    }
}
