#include "simulate/trace/ping.h"
#include "support/sonars.h"

namespace {

/// A sonar in tank() whose model has every term.
struct Everything {
    Scene scene = tank();
    std::unique_ptr<VisibilityEngine> engine = make_rays_engine(scene);
    Pose pose{.translation = {-3.0, 0.0, 1.5}};
    SonarConfig config;
    PingKey key{.seed = 7, .ping = 3};

    Everything() {
        config.multipath.method = MultipathMethod::cluster;
        config.noise.range_lambda_m = 0.04;
        config.noise.add_sigma = 0.08;
        config.streaks.mode = StreakMode::add;
    }

    Ping render(const Sonar& sonar) const { return render_ping(sonar, scene, *engine, pose, key); }
};

}  // namespace

TEST_CASE("a term left out of an image is a term that the sonar's settings do not have") {
    const Everything all;
    Sonar sonar = make_sonar(all.config, {});
    const TracedPing traced = trace(sonar, all.scene, *all.engine, all.pose, 0);
    const auto stages = form_stages(traced, sonar, all.scene, all.key);

    // From the whole ping downwards, one setting after the other is taken out and the ping traced
    // anew.
    REQUIRE(stages.size() == 5);
    CHECK(stages[4].intensity == all.render(sonar).intensity);
    change_paper_model(sonar, [](PaperModel& model) { model.streaks.mode = StreakMode::none; });
    CHECK(stages[3].intensity == all.render(sonar).intensity);
    change_paper_model(sonar, [](PaperModel& model) {
        model.pixel_noise.gain = 1.0F;
        model.pixel_noise.add_sigma = model.pixel_noise.mult_sigma = 0.0F;
    });
    CHECK(stages[2].intensity == all.render(sonar).intensity);
    change_paper_model(sonar, [](PaperModel& model) { model.range_noise.lambda_m = 0.0F; });
    CHECK(stages[1].intensity == all.render(sonar).intensity);
    sonar.settings.multipath.on = false;
    CHECK(stages[0].intensity == all.render(sonar).intensity);
    for (int k = 0; k < 4; ++k)
        CHECK(stages[k].intensity != stages[k + 1].intensity);
    CHECK(stages[0].counts.multipath.bounces == 0);
    CHECK(stages[1].counts.multipath.bounces == traced.bounces.size());
    CHECK(stages[3].counts.streak_rows == 0);
    CHECK(stages[4].counts.streak_rows > 0);
}

TEST_CASE("forming an image changes nothing that the next one is formed from") {
    const Everything all;
    const Sonar sonar = make_sonar(all.config, {});
    const TracedPing traced = trace(sonar, all.scene, *all.engine, all.pose, 0);
    const auto form = [&](const PingKey& key, const Terms& terms) {
        return form_image(traced, sonar.settings, all.scene, key, terms).intensity;
    };
    const std::vector<float> first = form(all.key, {});
    CHECK(form({.seed = 8, .ping = 3}, {}) != first);
    CHECK(form(all.key, direct_echoes_alone) != first);
    CHECK(form(all.key, {}) == first);
}

TEST_CASE("multipath that is not asked for is not traced, and can be traced later") {
    const Everything all;
    const Sonar sonar = make_sonar(all.config, {});
    TracedPing traced = trace(sonar, all.scene, *all.engine, all.pose, 0, direct_echoes_alone);
    CHECK(traced.counts.multipath.rays == 0);
    CHECK(traced.bounces.empty());
    for (int again = 0; again < 2; ++again) {
        trace_multipath(sonar.settings, all.scene, *all.engine, traced);
        const Ping ping = form_image(traced, sonar.settings, all.scene, all.key);
        CHECK(ping.intensity == all.render(sonar).intensity);
    }
}

TEST_CASE("where the surface echoes nothing, an image is that of the multipath alone") {
    const Everything all;
    const Sonar sonar = make_sonar(all.config, {});
    const TracedPing traced = trace(sonar, all.scene, *all.engine, all.pose, 0);
    const auto form = [&](const Terms& terms) {
        return form_image(traced, sonar.settings, all.scene, {}, terms);
    };
    const Ping direct = form(direct_echoes_alone);
    const Ping multipath = form(multipath_alone);
    const Ping both = form(without_random_terms);
    int alone = 0;
    for (std::size_t k = 0; k < both.intensity.size(); ++k) {
        if (direct.intensity[k] > 0.0F) continue;
        REQUIRE(both.intensity[k] == multipath.intensity[k]);
        alone += multipath.intensity[k] > 0.0F;
    }
    CHECK(alone > 10);
}
