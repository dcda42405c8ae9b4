#include "support/lattices.h"

#include "simulate/reference/reference.h"
#include "simulate/visibility/caster.h"
#include "support/calibrated.h"

namespace {

/// The image of a drawn scene by at most `rays`, in two independent halves.
Reference reference_of(const Lattice& lattice, std::uint64_t rays) {
    const View view = make_sonar(lattice.sonar, {}).settings.view;
    return cast_reference(Caster(lattice.scene), lattice.scene, view, Pose{}, {0.0005, 16.0, rays});
}

}  // namespace

TEST_CASE("lattices: the distance of a reference's halves is about its error") {
    // More rays move the image by about as much as the halves of the smaller cast are apart.
    for (const std::uint32_t number : {2U, 13U}) {
        const Lattice lattice = draw_lattice(number);
        const Reference few = reference_of(lattice, 200'000);
        const Reference many = reference_of(lattice, 1'600'000);
        CHECK(many.noise < few.noise);
        const double moved = image_error(few.intensity, many.intensity, many.scored).relative_l1;
        CHECK(moved < 1.5 * few.noise);
        CHECK(moved > 0.5 * few.noise);
    }
}

TEST_CASE("lattices: posts narrower than a column are seen") {
    // Profiling sonars over posts of stairs and rails of a ladder.
    const auto error = [](std::uint32_t number, double goal) -> double {
        const Lattice lattice = draw_lattice(number);
        const Reference reference = reference_of(lattice, 400'000);
        CHECK(reference.noise < 0.05);
        Sonar sonar = noise_free(lattice.sonar, goal);
        sonar.T_vehicle_sensor = Pose{};
        return image_error(expected_image(sonar, lattice.scene, EngineKind::strips),
                           reference.intensity, reference.scored)
            .relative_l1;
    };
    CHECK(error(257, 0.1) < 0.11);
    CHECK(error(145, 0.03) < 0.045);
}

TEST_CASE("lattices: a patch as narrow as rounding has a finite place") {
    // A net below an echosounder. The mean of two triangles without area was no number.
    const Lattice lattice = draw_lattice(14253);
    const auto engine = engine_of(lattice.scene, EngineKind::strips);
    const View view = make_sonar(lattice.sonar, {0.1}).settings.view;
    for (const Sample& sample : engine->visible_surface(view, Pose{}).items)
        CHECK(sample.position.allFinite());
}
