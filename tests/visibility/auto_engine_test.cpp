#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/water/sound_profile.h"
#include "visibility/strips/fixtures.h"

namespace {

View auto_view(double relative_l1 = 0.03) {
    return {radians(90.0), radians(20.0), 1.0, 25.0, 256, 128, relative_l1};
}

bool same(const Samples& a, const Samples& b) {
    return std::ranges::equal(a.items, b.items, [](const Sample& x, const Sample& y) {
        return x.position == y.position && x.normal == y.normal && x.edge_u == y.edge_u &&
               x.edge_v == y.edge_v && x.height_m == y.height_m && x.area_m2 == y.area_m2 &&
               x.material == y.material && x.instance == y.instance && x.strength == y.strength;
    });
}

}  // namespace

TEST_CASE("auto takes strips; multipath starts from rays") {
    const Scene scene = tank();
    const View view = auto_view();
    const Pose pose{.translation = {0.0, 0.0, 1.5}};
    const Samples by_strips = visible(scene, view, pose);
    const Samples by_rays = make_rays_engine(scene)->visible_surface(view, pose);
    for (const EngineKind type : {EngineKind::automatic, EngineKind::strips}) {
        const auto engine = engine_of(scene, type);
        CHECK(same(engine->visible_surface(view, pose), by_strips));
        CHECK(same(engine->by_rays().visible_surface(view, pose), by_rays));
    }
}

TEST_CASE("auto takes rays over many triangles, denser than the goal alone asks for") {
    Scene scene = floor_scene(20.0F, 0.0F, 0.3F, 1025);
    REQUIRE(scene.triangles.size() > many_triangles);
    const Caster caster(scene);
    View view = auto_view(0.12);
    view.beams = 16;
    const Pose pose = pitched(25.0, {-4.0, 0.0, 2.0});
    const Samples visible = engine_of(scene, EngineKind::automatic)->visible_surface(view, pose);
    CHECK(same(visible, make_rays_engine(scene, caster, 4)->visible_surface(view, pose)));
}

TEST_CASE("engine: what the octree and the strips refuse of copies, bodies and bent sound") {
    const Scene plain = tank();
    Scene copies = plain;
    copies.copies.push_back({});
    Scene moving = plain;
    moving.bodies.push_back({});
    Scene bent = plain;
    bent.sound_profile = std::make_shared<const SoundProfile>(
        SoundProfile{{-100.0, 100.0}, {1500.0, 1510.0}, 1480.0});
    const std::pair<const Scene*, std::string> scenes[] = {
        {&plain, ""},
        {&copies, " does not support copies of shared meshes; use engine: auto or engine: rays"},
        {&moving, " does not support moving objects; use engine: auto or engine: rays"},
        {&bent, "water.profile"}};
    for (const auto& scene : scenes) {
        const auto refusal = [&](EngineKind type) {
            return unsupported({.type = type}, *scene.first);
        };
        for (const EngineKind type : {EngineKind::automatic, EngineKind::rays})
            CHECK(refusal(type).empty());
        CHECK(refusal(EngineKind::strips).empty() == (scene.first != &bent));
        CHECK(refusal(EngineKind::octree).find(scene.second) != std::string::npos);
        CHECK(refusal(EngineKind::octree).empty() == scene.second.empty());
    }
}
