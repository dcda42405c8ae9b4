// Prints the range of the first echo of a wall 5 m ahead, from a scene that is made here; and of
// the first ping of each sonar of a mission its name and its bins with an echo, without noise.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "input/mission/parse.h"
#include "input/scene/scene.h"
#include "simulate/assembly/assemble.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"

using namespace sonarsim;

namespace {

void print_range_of_wall() {
    Scene scene;
    scene.vertices = {{5, -9, -9}, {5, 9, -9}, {5, 9, 9}, {5, -9, 9}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.triangle_material = {0, 0};
    scene.triangle_instance = {0, 0};
    scene.instances = {"wall"};
    scene.materials = {{.name = "concrete",
                        .density_kg_m3 = 2400.0,
                        .sound_speed_m_s = 3100.0,
                        .reflection = static_cast<float>(power_reflection(2400.0, 3100.0, {}))}};
    scene.bounds_min = {5, -9, -9};
    scene.bounds_max = {5, 9, 9};

    SonarConfig config;
    config.name = "fls";
    const Sonar sonar = make_sonar(config, AccuracyConfig{});
    const auto engine = make_engine(scene, EngineSettings{});
    const Ping ping = render_ping(sonar, scene, *engine, Pose{}, PingKey{});
    int bin = 0;
    while (bin < ping.range_bins && ping.at(bin, ping.beams / 2) == 0.0F)
        ++bin;
    std::cout << sonar.range_edges_m[bin] << '\n';
}

}  // namespace

int main(int, char** argv) {
    print_range_of_wall();
    const std::filesystem::path file = argv[1];
    const Mission mission = load_mission({file, file.parent_path()}, sonar_keys());
    const Assembly assembly = assemble(mission);
    const auto engine = make_engine(assembly.scene, EngineSettings{});
    for (const Sonar& sonar : assembly.sonars) {
        const Ping ping =
            render_ping(sonar, assembly.scene, *engine, assembly.trajectory.front().T_world_vehicle,
                        PingKey{mission.seed, 0}, without_random_terms);
        const auto occupied = ping.intensity.size() - std::ranges::count(ping.intensity, 0.0F);
        std::cout << sonar.config.name << ' ' << occupied << '\n';
    }
}
