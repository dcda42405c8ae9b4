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
        const double moved = image_error(few.intensity, many.intensity, many.scored).relative_l1;
        CHECK(moved < 1.5 * few.apart);
        CHECK(moved > 0.5 * few.apart);
    }
}

TEST_CASE("lattices: bars that stand between two slices are seen") {
    // Profiling sonars over posts of stairs and rails of a ladder. Two slices on either side of a
    // bar agree.
    const auto error = [](std::uint32_t number, double goal) -> double {
        const test::Lattice lattice = test::draw_lattice(number);
        const Reference reference = test::lattice_reference(lattice, 400'000);
        CHECK(reference.apart < 0.05);
        return test::lattice_errors(number, lattice, reference, EngineKind::slices, {goal})
            .front()
            .error;
    };
    CHECK(error(257, 0.1) < 0.11);
    CHECK(error(145, 0.03) < 0.045);
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
