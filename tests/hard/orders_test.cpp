#include "hard/cases.h"
#include "simulate/reference/image_error.h"
#include "simulate/reference/reference.h"
#include "simulate/visibility/make_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

TEST_CASE("the error of rays falls with their goal") {
    struct Subject {
        const char* name;
        Scene scene;
        double pitch_deg;
        Eigen::Vector3d position;
    };
    const Subject subjects[] = {{"smooth", test::rough_floor(), 35.0, {0.3, 0.2, 4.0}},
                                {"edgy", test::tank(), 15.0, {-2.4, 0.4, 1.5}},
                                {"grazing", test::rough_floor(), 5.0, {0.3, 0.2, 1.3}}};
    Sonar sonar = in_tank(SonarKind::imaging).sonar;
    for (const Subject& subject : subjects) {
        CAPTURE(subject.name);
        const Pose pose{rotation_from_rpy(0.0, radians(subject.pitch_deg), 0.1), subject.position};
        const Reference truth =
            cast_reference(Caster(subject.scene), subject.scene, sonar.settings.view, pose,
                           {0.001, 256.0, 16'000'000});
        const std::unique_ptr<VisibilityEngine> engine =
            make_engine(subject.scene, {EngineKind::rays, {}});
        double first = 0.0;
        for (const double goal : {0.24, 0.12, 0.06, 0.03, 0.015}) {
            CAPTURE(goal);
            sonar.settings.view.relative_l1 = goal;
            const Ping ping = render_ping(sonar, subject.scene, *engine, pose, {1, 0});
            const double error = image_error(ping.intensity, truth.intensity).relative_l1;
            if (first == 0.0) first = error;
            CHECK(error < 1.2 * goal);  // a single pose may miss its goal
            // Silhouettes and bin edges limit the order of convergence to one.
            CHECK(error <= 1.1 * first * std::pow(goal / 0.24, 0.4));
        }
    }
}

TEST_SUITE_END();
