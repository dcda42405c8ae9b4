// The first ping of each sonar of a mission: prints the sonar's name and the number of its bins
// with an echo, without noise.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "input/mission/parse.h"
#include "simulate/assembly/assemble.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"

using namespace sonarsim;

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: mission_ping mission.yaml\n";
        return 2;
    }
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
