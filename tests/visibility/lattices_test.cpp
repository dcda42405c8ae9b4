#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/foreign_meshes.h"
#include "support/lattice_errors.h"
#include "support/sanitized.h"
#include "validation/image_error.h"
#include "visibility/make_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("lattices");

TEST_CASE("lattices: the distance of a reference's halves is about its error" *
          doctest::skip(test::sanitized)) {
    // More rays move the image by about as much as the halves of the smaller cast are apart.
    for (const std::uint32_t number : {2U, 13U}) {
        const test::Lattice lattice = test::draw_lattice(number);
        const Reference few = test::lattice_reference(lattice, 200'000);
        const Reference many = test::lattice_reference(lattice, 1'600'000);
        CHECK(many.apart < few.apart);
        const double moved = image_error(few.intensity, many.intensity).relative_l1;
        CHECK(moved < 1.5 * few.apart);
        CHECK(moved > 0.5 * few.apart);
    }
}

TEST_CASE("lattices: bars that stand between two slices are seen") {
    // Profiling sonars over posts of stairs and rails of a ladder. Two slices on either side of a
    // bar agreed, and the errors were 0.32 and 0.09. The second goal is met; the first is missed by
    // a tenth at most.
    const auto error = [](std::uint32_t number, double goal) -> double {
        const test::Lattice lattice = test::draw_lattice(number);
        const Reference reference = test::lattice_reference(lattice, 400'000);
        CHECK(reference.apart < 0.05);
        return test::lattice_errors(number, lattice, reference, EngineKind::slices, {goal})
            .front()
            .error;
    };
    CHECK(error(257, 0.1) < 0.11);
    CHECK(error(145, 0.03) < 0.03);
}

TEST_CASE("lattices: views of few bins are looked at twice") {
    // Scenes that the first look missed: stairs below an echosounder and in a side-scan, of which
    // both sets of slices saw the same posts too wide or not at all. Errors at a goal of 3 % were
    // 6.7 % with an estimate of 2.2 %, and 26 % with one of 17 %. They are 1.8 and 1.2 % now.
    for (const std::uint32_t number : {13053U, 13107U}) {
        const test::Lattice lattice = test::draw_lattice(number);
        const Reference reference = test::lattice_reference(lattice, 1'000'000);
        CAPTURE(number);
        CHECK(reference.apart < 0.03);
        const test::LatticeError error =
            test::lattice_errors(number, lattice, reference, EngineKind::slices, {0.03}).front();
        CHECK(error.error < 0.03);
        CHECK(error.estimate <= 0.03);
    }
}

TEST_CASE("lattices: rays decide about the bins at the ends of surface") {
    // One bin that all slices filled by mistake had most of the error: pipes below an echosounder
    // (3.5 % at a goal of 3 %, estimate 0.7 %), stairs below another (1.4 % at 1 %, 0.3 %) and
    // leaves before a profiling sonar (1.2 % at 1 %, 0.4 %). The errors are 0.8, 0.2 and 0.3 % now.
    struct Case {
        std::uint32_t number;
        double goal;
    };
    for (const Case& c : {Case{14237, 0.03}, Case{14189, 0.01}, Case{14033, 0.01}}) {
        const test::Lattice lattice = test::draw_lattice(c.number);
        const Reference reference = test::lattice_reference(lattice, 1'000'000);
        const test::LatticeError error =
            test::lattice_errors(c.number, lattice, reference, EngineKind::slices, {c.goal})
                .front();
        CAPTURE(c.number);
        CHECK(error.error - error.reference < 0.6 * c.goal);
        CHECK(error.estimate <= c.goal);
    }
}

TEST_CASE("lattices: faces that are seen edge-on are not lost") {
    // Pipes and a net. Their faces were taken for cracks by rounding: errors were 3.1 and 2.1 %.
    for (const std::uint32_t number : {15078U, 14051U}) {
        const test::Lattice lattice = test::draw_lattice(number);
        const Reference reference = test::lattice_reference(lattice, 1'000'000);
        const test::LatticeError error =
            test::lattice_errors(number, lattice, reference, EngineKind::slices, {0.01}).front();
        CAPTURE(number);
        CHECK(error.error - error.reference < 0.01);
        // The second one has an estimate of 1.2 %.
        CHECK(error.estimate <= 0.015);
    }
}

TEST_CASE("lattices: fans of few bins have enough beams checked" * doctest::skip(test::sanitized)) {
    // A net, stairs and pipes with 370 to 980 bins in 256 beams. With 16 beams checked, errors
    // were 3.6 to 5.5 % at a goal of 3 %, the estimates 0.7 to 2.7 %.
    for (const std::uint32_t number : {14256U, 18160U, 20018U, 20112U}) {
        const test::Lattice lattice = test::draw_lattice(number);
        const auto image = [&](const EngineSettings& settings) {
            const auto engine = make_engine(lattice.scene, settings);
            return test::render_lattice(lattice, *engine, 0.03);
        };
        const Ping usual = image({.type = EngineKind::slices, .octree = {}});
        const Ping fine =
            image({.type = EngineKind::slices, .octree = {}, .slices = {.per_beam = 64}});
        CAPTURE(number);
        CHECK(image_error(usual.intensity, fine.intensity).relative_l1 < 1.2 * 0.03);
        CHECK(usual.estimated_l1 <= 0.03);
    }
}

TEST_CASE("lattices: a patch as narrow as rounding has a finite place") {
    // A net below an echosounder. The mean of two triangles without area was no number.
    const test::Lattice lattice = test::draw_lattice(14253);
    const auto engine = make_engine(lattice.scene, {.type = EngineKind::slices, .octree = {}});
    const View view = make_sonar(lattice.sonar, {0.1}).settings.view;
    for (const Sample& sample : engine->visible_surface(view, Pose{}).items)
        CHECK(sample.position.allFinite());
}

TEST_CASE("lattices: goals are met, or the estimate says so" * doctest::skip(test::sanitized)) {
    // Twenty scenes with two goals each, and twenty of shapes that no estimate was developed on. If
    // 3 % of 40 independent pings were missed in silence, more than 4 would be with a probability
    // of 0.5 %. The two goals of a scene are not independent, so the true probability is larger.
    // Without the check of slices 7 of the first set are missed.
    for (const test::ShapeSet set : {test::ShapeSet::known, test::ShapeSet::kept_aside}) {
        int silent = 0;
        int vain = 0;
        int pings = 0;
        for (std::uint32_t number = 2000; pings < 40; ++number) {
            const test::Lattice lattice = test::draw_lattice(number, set);
            const Reference reference = test::lattice_reference(lattice, 1'000'000);
            for (const test::LatticeError& error : test::lattice_errors(
                     number, lattice, reference, EngineKind::slices, {0.1, 0.03})) {
                ++pings;
                silent += error.missed_in_silence() ? 1 : 0;
                vain += error.warned_in_vain() ? 1 : 0;
                CAPTURE(number);
                CAPTURE(error.goal);
                CHECK(std::isfinite(error.estimate));
            }
        }
        CHECK(silent <= 4);
        CHECK(vain <= 8);
    }
}

/// Prints the table of docs/performance.md: SONARSIM_LATTICES scenes from number SONARSIM_FIRST on,
/// with the engine SONARSIM_ENGINE: slices, rays or octree. SONARSIM_SHAPES=kept_aside draws other
/// shapes; the name of a folder draws the .glb files in it.
TEST_CASE("table of errors and estimates on drawn lattices" * doctest::skip()) {
    const auto setting = [](const char* name, const char* otherwise) -> std::string {
        const char* const text = std::getenv(name);
        return text != nullptr ? text : otherwise;
    };
    const int count = std::stoi(setting("SONARSIM_LATTICES", "20"));
    const int first = std::stoi(setting("SONARSIM_FIRST", "0"));
    const std::string name = setting("SONARSIM_ENGINE", "slices");
    EngineKind engine = EngineKind::slices;
    if (name == "rays") engine = EngineKind::rays;
    if (name == "octree") engine = EngineKind::octree;
    const std::string shapes = setting("SONARSIM_SHAPES", "known");
    std::vector<test::ForeignMesh> meshes;
    if (shapes != "known" && shapes != "kept_aside") {
        meshes = test::foreign_meshes(shapes);
        REQUIRE(!meshes.empty());
    }
    const auto draw = [&](std::uint32_t number) -> test::Lattice {
        if (!meshes.empty()) return test::draw_foreign_mesh(number, meshes);
        return test::draw_lattice(
            number, shapes == "known" ? test::ShapeSet::known : test::ShapeSet::kept_aside);
    };
    std::vector<test::LatticeError> all;
    for (int i = first; i < first + count; ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        const test::Lattice lattice = draw(number);
        const Reference reference = test::lattice_reference(lattice, 8'000'000);
        for (const test::LatticeError& error :
             test::lattice_errors(number, lattice, reference, engine, {0.1, 0.03, 0.01}))
            all.push_back(error);
    }
    std::puts(test::lattice_table(all).c_str());
}

TEST_SUITE_END();
