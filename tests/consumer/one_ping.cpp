// One ping of an imaging sonar at a wall of concrete 5 m ahead: prints the range of the first echo.
#include <iostream>

#include "input/scene/scene.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"

using namespace sonarsim;

int main() {
    const Water water;
    Scene scene;
    scene.vertices = {{5, -9, -9}, {5, 9, -9}, {5, 9, 9}, {5, -9, 9}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.triangle_material = {0, 0};
    scene.triangle_instance = {0, 0};
    scene.instances = {"wall"};
    scene.materials = {{.name = "concrete",
                        .density_kg_m3 = 2400.0,
                        .sound_speed_m_s = 3100.0,
                        .reflection = static_cast<float>(power_reflection(2400.0, 3100.0, water))}};
    scene.bounds_min = {5, -9, -9};
    scene.bounds_max = {5, 9, 9};

    SonarConfig config;
    config.name = "fls";
    const Sonar sonar = make_sonar(config, AccuracyConfig{});
    const auto engine = make_engine(scene, EngineSettings{});
    const Ping ping = render_ping(sonar, scene, *engine, Pose{}, PingKey{});
    for (int i = 0; i < ping.range_bins; ++i) {
        if (ping.at(i, ping.beams / 2) == 0.0F) continue;
        std::cout << sonar.range_edges_m[i] << '\n';
        return 0;
    }
    std::cerr << "no echo\n";
    return 1;
}
