#include "support/small_mission.h"

namespace fs = std::filesystem;

namespace {

RenderSummary run_with(const Mission& mission, const JobCallback& progress,
                       const std::atomic<bool>& stop = false) {
    return run_job(mission, small_assembly(mission, poses), {.threads = 1}, progress, stop);
}

bool is_complete(const fs::path& folder) {
    return nlohmann::json::parse(read_file(folder / "dataset.json", 1 << 20)).at("complete");
}

}  // namespace

TEST_CASE_FIXTURE(MissionInFolder, "job: a ping that saw nothing is there like any other") {
    // Straight up out of the tank: without noise every record is zero.
    mission = survey_mission(out);
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
    Mission shards = mission;
    shards.output.folder = temporary.path / "shards";
    CHECK_FALSE(run(shards, {.shard = 0, .shards = 2}).complete);
    CHECK(run(shards, {.shard = 1, .shards = 2}).complete);
}

TEST_CASE_FIXTURE(MissionInFolder,
                  "job: a file that goes away during the run is no part of a complete dataset") {
    mission = survey_mission(out);
    const auto thief = [&](const RenderSummary& so_far, std::uint64_t total) {
        if (so_far.pings == total) fs::remove(out / "front/polar/000000.npy");
    };
    CHECK_THROWS_AS(run_with(mission, thief), std::runtime_error);
    CHECK_FALSE(is_complete(out));
    CHECK(run(mission).pings == 1);
    const auto whole = contents(out);
    // Records, which may also be replaced by a copy.
    const fs::path file = out / "mbes/soundings.npy";
    for (const bool replaced : {false, true}) {
        fs::remove_all(out);
        const auto thief_of_records = [&](const RenderSummary& so_far, std::uint64_t) {
            if (so_far.pings != 1) return;
            if (replaced) fs::copy_file(file, temporary.path / "copy");
            fs::remove(file);
            if (replaced) fs::rename(temporary.path / "copy", file);
        };
        CHECK_THROWS_AS(run_with(mission, thief_of_records), std::runtime_error);
        CHECK_FALSE(is_complete(out));
        CHECK(run(mission).complete);
        CHECK(contents(out) == whole);
    }
}

TEST_CASE_FIXTURE(MissionInFolder,
                  "job: lines of the journal that are torn or made up do not count") {
    mission.sensors[0].name = "journal";  // a sensor may have this name
    run(mission);
    const auto whole = contents(out);
    fs::remove_all(out);
    std::atomic<bool> stop = false;
    const RenderSummary first = run_with(
        mission, [&](const RenderSummary& so_far, std::uint64_t) { stop = so_far.pings >= 4; },
        stop);
    CHECK(first.stopped);
    const fs::path part = out / "journal.d/1-of-1.txt";
    const std::string lines = read_file(part, 1 << 20);
    write_file(part, lines.substr(0, lines.size() - 3) + "\nping 0 6 1 1 1 1 00000000\nping\n");
    const RenderSummary rest = run(mission);
    CHECK(rest.complete);
    CHECK(rest.skipped > 0);
    CHECK(contents(out) == whole);
}

TEST_CASE_FIXTURE(MissionInFolder,
                  "job: a shard leaves the temporary files of another one, the last removes them") {
    const fs::path half = out / "front/polar/.000001.npy.0123456789abcdef.part";
    // Ten pings: 0, 3, 6, 9 then 1, 4, 7 then 2, 5, 8. The last two of 12 shards have none.
    CHECK(run(mission, {.shard = 2, .shards = 3}).pings == 3);
    write_file(half, "at work");
    CHECK(run(mission, {.shard = 0, .shards = 3}).pings == 4);
    CHECK(fs::exists(half));
    CHECK_FALSE(is_complete(out));
    CHECK(run(mission, {.shard = 1, .shards = 3}).complete);
    CHECK_FALSE(fs::exists(half));
    const RenderSummary idle =
        run(small_mission(temporary.path / "idle"), {.shard = 11, .shards = 12});
    CHECK(idle.pings == 0);
    CHECK_FALSE(idle.complete);
}

TEST_CASE_FIXTURE(MissionInFolder, "job: options that make no sense are refused") {
    CHECK_THROWS_AS(run(mission, {.threads = -1}), InputError);
    CHECK_THROWS_AS(run(mission, {.shard = 2, .shards = 2}), InputError);
    CHECK_THROWS_AS(run(mission, {.shard = -1, .shards = 2}), InputError);
    CHECK_THROWS_AS(run(mission, {.shard = 0, .shards = 0}), InputError);
    CHECK_THROWS_AS(run(mission, {.shard = 0, .shards = 2, .overwrite = true}), InputError);
    CHECK_FALSE(fs::exists(out));
}

TEST_CASE("series: shards merged by copying lose records, and one more run brings them back") {
    const TemporaryFolder temporary;
    run(survey_mission(temporary.path / "whole"));
    const fs::path merged = temporary.path / "merged";
    for (int shard = 0; shard < 2; ++shard) {
        const fs::path out = temporary.path / std::to_string(shard);
        run(survey_mission(out), {.shard = shard, .shards = 2});
        fs::copy(out, merged, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    }
    const RenderSummary summary = run(survey_mission(merged));
    CHECK(summary.pings > 0);
    CHECK(summary.complete);
    const auto whole = contents(temporary.path / "whole");
    CHECK(contents(merged) == whole);
    // A picture is made again without a ping.
    fs::remove(merged / "sounder/echogram_view.png");
    CHECK(run(survey_mission(merged)).pings == 0);
    CHECK(contents(merged) == whole);
}
