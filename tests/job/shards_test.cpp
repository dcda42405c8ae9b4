#include <doctest/doctest.h>

#include "core/file.h"
#include "job/small_job.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

TEST_SUITE("job") {
    TEST_CASE("job: shards share a folder, and the last one completes it") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = small_mission(out);
        // Ten pings: 0, 3, 6, 9 then 1, 4, 7 then 2, 5, 8.
        const RenderSummary third = run(mission, {.shard = 2, .shards = 3});
        CHECK(third.pings == 3);
        CHECK_FALSE(third.complete);
        CHECK_FALSE(is_complete(out));
        // A shard leaves the temporary files of another one that may be at work; the run that
        // completes the dataset removes them.
        write_file(out / "front/polar/.000001.npy.0123456789abcdef.part", "at work");
        CHECK(run(mission, {.shard = 0, .shards = 3}).pings == 4);
        CHECK(fs::exists(out / "front/polar/.000001.npy.0123456789abcdef.part"));
        const RenderSummary last = run(mission, {.shard = 1, .shards = 3});
        CHECK(last.complete);
        CHECK(is_complete(out));
        CHECK(contents(out) == whole_dataset());
    }

    TEST_CASE("job: shards in folders of their own are merged, and one more run completes them") {
        const TemporaryFolder temporary;
        const fs::path merged = temporary.path / "merged";
        for (int shard = 0; shard < 2; ++shard) {
            const fs::path out = temporary.path / std::to_string(shard);
            CHECK_FALSE(run(small_mission(out), {.shard = shard, .shards = 2}).complete);
            fs::copy(out, merged,
                     fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
        CHECK_FALSE(is_complete(merged));
        const RenderSummary summary = run(small_mission(merged));
        CHECK(summary.pings == 0);
        CHECK(summary.complete);
        CHECK(contents(merged) == whole_dataset());
    }

    TEST_CASE("job: more shards than pings leave some with nothing to do") {
        const TemporaryFolder temporary;
        const RenderSummary idle =
            run(small_mission(temporary.path / "out"), {.shard = 11, .shards = 12});
        CHECK(idle.pings == 0);
        CHECK_FALSE(idle.complete);
        CHECK_FALSE(idle.stopped);
    }
}
