#include "trace/missed_multipath.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/bounces.h"
#include "support/ghosts.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "trace/traced_ping.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A fan of 128 beams with an error goal of 3 %.
const View view = fan(60.0, 20.0);

constexpr double most_missed = 0.05;

/// As few bins that a ghost occupies less than 30 of them.
View coarse_view() {
    View coarse = view;
    coarse.beams = 24;
    coarse.range_bins = 64;
    return coarse;
}

/// Counts of drawn ghosts.
struct Tally {
    int ghosts = 0;
    int missed = 0;  ///< more than 5 % of the bins are missed
    int silent = 0;  ///< and the estimate is at most 5 %
    int vain = 0;    ///< at most 5 % are missed or filled by mistake, but the estimate is more
    double found = 0.0;
    double relative_l1 = 0.0;

    void add(const GhostError& error) {
        ++ghosts;
        const bool warned = error.estimate > most_missed;
        missed += error.missed > most_missed ? 1 : 0;
        silent += error.missed > most_missed && !warned ? 1 : 0;
        vain += error.missed <= most_missed && error.by_mistake <= most_missed && warned ? 1 : 0;
        found += 1.0 - error.missed;
        relative_l1 += error.relative_l1;
    }
};

/// Prints the errors of the ghosts of numbers first to end - 1 that occupy `fewest` to `most` bins.
void print_table(const View& sonar, int fewest, int most, int first, int end) {
    constexpr int columns[] = {1, 2, 4};
    constexpr double goals[] = {0.1, 0.03, 0.01};
    Tally tallies[3][3];
    for (int number = first; number < end; ++number) {
        const Ghost ghost = draw_ghost(static_cast<std::uint32_t>(number));
        const std::vector<float> reference = ghost_reference(ghost, sonar, 2'000'000);
        const int bins = occupied_bins(reference);
        if (bins < fewest || bins > most) continue;
        for (int g = 0; g < 3; ++g) {
            for (int c = 0; c < 3; ++c) {
                View at_goal = sonar;
                at_goal.relative_l1 = goals[g];
                tallies[g][c].add(ghost_error(ghost, at_goal, columns[c], reference));
            }
        }
    }
    std::printf("%d ghosts\n\n", tallies[0][0].ghosts);
    std::puts("| goal | columns | found | L1 | missed | in silence | warned in vain |");
    std::puts("|---|---|---|---|---|---|---|");
    for (int g = 0; g < 3; ++g) {
        for (int c = 0; c < 3; ++c) {
            const Tally& t = tallies[g][c];
            std::printf("| %.0f %% | %d | %.0f %% | %.0f %% | %d | %d | %d |\n", 100.0 * goals[g],
                        columns[c], 100.0 * t.found / t.ghosts, 100.0 * t.relative_l1 / t.ghosts,
                        t.missed, t.silent, t.vain);
        }
    }
    std::puts("");
}

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("bins of ghosts are found, or the estimate says so" * doctest::skip(test::sanitized)) {
    // Eight ghosts. With one column per beam most of them lack more than 5 % of their bins, which
    // was silent without the estimate. Four columns find more.
    Tally one;
    Tally four;
    for (std::uint32_t number = 1000; one.ghosts < 8; ++number) {
        const Ghost ghost = draw_ghost(number);
        const std::vector<float> reference = ghost_reference(ghost, view, 200'000);
        if (occupied_bins(reference) < 30) continue;
        one.add(ghost_error(ghost, view, 1, reference));
        four.add(ghost_error(ghost, view, 4, reference));
    }
    CHECK(one.missed >= 6);
    CHECK(one.silent == 0);
    CHECK(four.silent <= 1);
    CHECK(four.found > one.found);
    CHECK(four.relative_l1 < one.relative_l1);
}

TEST_CASE("ghosts of a few bins have an estimate" * doctest::skip(test::sanitized)) {
    // The two images of a ghost of a few bins may agree by chance. Among 695 pings that missed more
    // than 5 % of fewer than 40 bins, 65 were silent (numbers 8000 to 9199, 1 to 4 columns). At
    // that rate more than 10 of 30 have a probability below 0.001.
    Tally few;
    for (std::uint32_t number = 11000; few.ghosts < 60; ++number) {
        const Ghost ghost = draw_ghost(number);
        const std::vector<float> reference = ghost_reference(ghost, coarse_view(), 50'000);
        const int bins = occupied_bins(reference);
        if (bins < 1 || bins >= 30) continue;
        few.add(ghost_error(ghost, coarse_view(), 2, reference));
    }
    CHECK(few.missed >= 20);
    CHECK(few.silent <= few.missed / 3);
}

TEST_CASE("a corner of two walls is found, and the estimate agrees") {
    // Against 2 million random rays 4 % of the bins are missed: those at the edges of the walls.
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.6F);
    add_quad(scene, {0, 2, -3}, {5, 2, -3}, {5, 2, 3}, {0, 2, 3}, m);
    add_quad(scene, {5, -9, -3}, {5, 2, -3}, {5, 2, 3}, {5, -9, 3}, m);
    TraceSettings settings;
    settings.view = fan(60.0, 12.0);
    settings.guard_beams.divided = 2;
    settings.multipath.on = true;
    TracedPing traced = trace_ping(settings, scene, *make_rays_engine(scene), Pose{});
    REQUIRE(traced.bounces.size() > 500);
    CHECK(traced.missed_multipath < most_missed);
    // Six of seven samples are taken away, so that less is found twice.
    std::erase_if(traced.bounces, [](const BouncePath& b) { return b.sample % 7 != 0; });
    CHECK(missed_multipath(settings.view, 2, traced.samples, traced.bounces) > most_missed);
}

TEST_CASE(
    "images without multipath, and sonars with one beam, have no estimate of their multipath") {
    Scene sphere = empty_scene();
    add_sphere(sphere, {4, 0, 0}, 0.8F, add_material(sphere, 0.6F), 64);
    const Found nothing = find(sphere, view, clusters_of(0));
    CHECK(std::isnan(missed_multipath(view, 1, nothing.samples, nothing.bounces)));
    View cone = view;
    cone.shape = ViewShape::cone;
    cone.beams = 1;
    const Found found = find(tank(), cone, clusters_of(0), tank_poses()[0]);
    CHECK(!found.bounces.empty());
    CHECK(std::isnan(missed_multipath(cone, 1, found.samples, found.bounces)));
}

TEST_CASE("tables of drawn ghosts" * doctest::skip()) {
    // The tables of docs/performance.md: SONARSIM_GHOSTS scenes from number SONARSIM_FIRST on.
    const auto setting = [](const char* name, int otherwise) -> int {
        const char* const text = std::getenv(name);
        return text != nullptr ? std::stoi(text) : otherwise;
    };
    const int first = setting("SONARSIM_FIRST", 0);
    const int end = first + setting("SONARSIM_GHOSTS", 20);
    print_table(view, 30, 1 << 20, first, end);
    print_table(coarse_view(), 1, 29, first, end);
}

TEST_SUITE_END();
