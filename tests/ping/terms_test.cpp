#include "simulate/trace/ping.h"
#include "support/sonars.h"

namespace {

Sonar with_every_term() {
    SonarConfig config;
    config.multipath.method = MultipathMethod::cluster;
    config.noise.range_lambda_m = 0.04;
    config.noise.add_sigma = 0.08;
    config.streaks.mode = StreakMode::add;
    return make_sonar(config, {});
}

/// A sonar in tank() whose model has every term, and a ping of it.
struct Everything {
    Scene scene = tank();
    std::unique_ptr<VisibilityEngine> engine = make_rays_engine(scene);
    Pose pose{.translation = {-3.0, 0.0, 1.5}};
    PingKey key{.seed = 7, .ping = 3};
    Sonar sonar = with_every_term();
    TracedPing traced = trace(sonar, scene, *engine, pose, 0);

    std::vector<float> render() const {
        return render_ping(sonar, scene, *engine, pose, key).intensity;
    }
    std::vector<float> form(const PingKey& of, const Terms& terms) const {
        return form_image(traced, sonar.settings, scene, of, terms).intensity;
    }
};

}  // namespace

TEST_CASE_FIXTURE(Everything,
                  "a term left out of an image is a term that the sonar's settings do not have") {
    const auto stages = form_stages(traced, sonar, scene, key);

    // From the whole ping downwards, one setting after the other is taken out, and the ping traced.
    REQUIRE(stages.size() == 5);
    CHECK(stages[4].intensity == render());
    change_paper_model(sonar, [](PaperModel& model) { model.streaks.mode = StreakMode::none; });
    CHECK(stages[3].intensity == render());
    change_paper_model(sonar, [](PaperModel& model) {
        model.pixel_noise.gain = 1.0F;
        model.pixel_noise.add_sigma = model.pixel_noise.mult_sigma = 0.0F;
    });
    CHECK(stages[2].intensity == render());
    change_paper_model(sonar, [](PaperModel& model) { model.range_noise.lambda_m = 0.0F; });
    CHECK(stages[1].intensity == render());
    sonar.settings.multipath.on = false;
    CHECK(stages[0].intensity == render());
    for (int k = 0; k < 4; ++k)
        CHECK(stages[k].intensity != stages[k + 1].intensity);
    CHECK(stages[0].counts.multipath.bounces == 0);
    CHECK(stages[1].counts.multipath.bounces == traced.bounces.size());
    CHECK(stages[3].counts.streak_rows == 0);
    CHECK(stages[4].counts.streak_rows > 0);
}

TEST_CASE_FIXTURE(Everything, "forming an image changes nothing that the next one is formed from") {
    const std::vector<float> first = form(key, {});
    CHECK(form({.seed = 8, .ping = 3}, {}) != first);
    CHECK(form(key, direct_echoes_alone) != first);
    CHECK(form(key, {}) == first);
}

TEST_CASE_FIXTURE(Everything,
                  "multipath that is not asked for is not traced, and can be traced later") {
    traced = trace(sonar, scene, *engine, pose, 0, direct_echoes_alone);
    CHECK(traced.counts.multipath.rays == 0);
    CHECK(traced.bounces.empty());
    for (int again = 0; again < 2; ++again) {
        trace_multipath(sonar.settings, scene, *engine, traced);
        CHECK(form(key, {}) == render());
    }
}

TEST_CASE_FIXTURE(Everything,
                  "where the surface echoes nothing, an image is that of the multipath alone") {
    const std::vector<float> direct = form({}, direct_echoes_alone);
    const std::vector<float> multipath = form({}, multipath_alone);
    const std::vector<float> both = form({}, without_random_terms);
    int alone = 0;
    for (std::size_t k = 0; k < both.size(); ++k) {
        if (direct[k] > 0.0F) continue;
        REQUIRE(both[k] == multipath[k]);
        alone += multipath[k] > 0.0F;
    }
    CHECK(alone > 10);
}
