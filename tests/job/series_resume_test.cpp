#include "job/small_job.h"
#include "support/npy_data.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

TEST_SUITE("job") {
    TEST_CASE("series: bytes depend neither on threads nor on interruptions nor on shards") {
        const TemporaryFolder temporary;
        const auto whole = [&] {
            run(survey_mission(temporary.path / "whole"), {.threads = 1});
            return contents(temporary.path / "whole");
        }();
        run(survey_mission(temporary.path / "two"), {.threads = 2});
        CHECK(contents(temporary.path / "two") == whole);

        const Mission stopped = survey_mission(temporary.path / "stopped");
        std::atomic<bool> stop = false;
        const RenderSummary first = run_job(
            stopped, small_assembly(stopped, poses), {.threads = 1},
            [&](const RenderSummary& so_far, std::uint64_t) { stop = so_far.pings >= 9; }, stop);
        CHECK(first.stopped);
        // Record files can be opened at once; missing records are zero; products come at the end.
        const auto part =
            data_of<float>(temporary.path / "stopped/sss/waterfall.npy", {"<f4", {7, 192}});
        CHECK(std::any_of(part.begin(), part.begin() + 192, [](float v) { return v > 0.0F; }));
        CHECK(std::all_of(part.end() - 192, part.end(), [](float v) { return v == 0.0F; }));
        CHECK_FALSE(fs::exists(temporary.path / "stopped/sss/waterfall.png"));
        const RenderSummary second = run(stopped);
        CHECK(second.skipped == first.pings);
        CHECK(contents(temporary.path / "stopped") == whole);

        const Mission shared = survey_mission(temporary.path / "shared");
        CHECK_FALSE(run(shared, {.shard = 1, .shards = 2}).complete);
        CHECK(run(shared, {.shard = 0, .shards = 2}).complete);
        CHECK(contents(temporary.path / "shared") == whole);
    }

    TEST_CASE("series: shards merged by copying lose records, and one more run brings them back") {
        const TemporaryFolder temporary;
        run(survey_mission(temporary.path / "whole"));
        const fs::path merged = temporary.path / "merged";
        for (int shard = 0; shard < 2; ++shard) {
            const fs::path out = temporary.path / std::to_string(shard);
            run(survey_mission(out), {.shard = shard, .shards = 2});
            fs::copy(out, merged,
                     fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
        const RenderSummary summary = run(survey_mission(merged));
        CHECK(summary.pings > 0);
        CHECK(summary.complete);
        CHECK(contents(merged) == contents(temporary.path / "whole"));
    }

    TEST_CASE(
        "series: pictures are made again without a ping, an old folder of a sensor goes whole") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = survey_mission(out);
        run(mission);
        const auto whole = contents(out);
        fs::remove(out / "sounder/echogram_view.png");
        CHECK(run(mission).pings == 0);
        CHECK(contents(out) == whole);
        write_file(out / "sss/mine.txt", "mine");
        CHECK(run(mission, {.overwrite = true}).pings == 25);
        CHECK(contents(out) == whole);
    }
}
