#include "support/small_mission.h"

#include "simulate/assembly/brightness.h"
#include "support/sonars.h"

namespace sonarsim::test {

Mission small_mission(const std::filesystem::path& output_folder) {
    SonarConfig front;
    front.name = "front";
    front.azimuth_deg = 60.0;
    front.elevation_deg = 12.0;
    front.range_bins = 48;
    front.azimuth_bins = 32;
    front.mount.translation_m = {0.5, 0.0, 0.0};
    front.noise = {.range_lambda_m = 0.05, .add_sigma = 0.1, .mult_sigma = 0.2};
    SonarConfig left = front;
    left.name = "left";
    left.every = 3;
    left.mount.rpy_deg = {0.0, 0.0, 90.0};
    Mission mission;
    mission.name = "small";
    mission.seed = 18446744073709551615U;
    mission.scene = {"tank.gltf", "materials.csv"};
    mission.trajectory = FileTrajectoryConfig{"poses.csv", 0.0};
    mission.sensors = {front, left};
    mission.output.folder = output_folder;
    mission.output.image = true;
    mission.output.full_scale = 0.5;
    return mission;
}

Mission survey_mission(const std::filesystem::path& output_folder) {
    Mission mission = small_mission(output_folder);
    SonarConfig front = mission.sensors[0];
    SonarConfig mbes = default_sonar(SonarKind::profiling);
    mbes.name = "mbes";
    set_range(mbes, 0.3, 4.0, 80);
    mbes.azimuth_bins = 40;
    mbes.noise = {.range_lambda_m = 0.02, .add_sigma = 0.01, .mult_sigma = 0.1};
    SonarConfig sss = default_sonar(SonarKind::sidescan);
    sss.name = "sss";
    set_range(sss, 0.3, 5.0, 90);
    sss.noise = {.add_sigma = 0.01, .mult_sigma = 0.1};
    SonarConfig sounder = default_sonar(SonarKind::echosounder);
    sounder.name = "sounder";
    sounder.every = 2;
    set_range(sounder, 0.3, 3.0, 60);
    sounder.noise = {.range_lambda_m = 0.02, .add_sigma = 0.01, .mult_sigma = 0.1};
    mission.name = "survey";
    mission.sensors = {front, mbes, sss, sounder};
    return mission;
}

Assembly small_assembly(const Mission& mission, int poses) {
    Assembly assembly;
    assembly.scene = tank();
    for (int i = 0; i < poses; ++i) {
        assembly.trajectory.push_back(
            {0.1 * i,
             {Eigen::Quaterniond::Identity(), Eigen::Vector3d(-3.0 + 0.05 * i, 0.0, 1.5)}});
    }
    for (const SonarConfig& sensor : mission.sensors) {
        assembly.sonars.push_back(make_sonar(sensor, mission.accuracy));
    }
    assembly.objects = group_objects(assembly.scene, {});
    assembly.scene.is_bottom.assign(assembly.scene.instances.size(), 1);
    assembly.full_scales = find_full_scales(mission, assembly.scene, assembly.trajectory,
                                            assembly.motions, assembly.sonars, *assembly.trees)
                               .full_scales;
    return assembly;
}

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        files[std::filesystem::relative(entry.path(), folder).string()] =
            read_file(entry.path(), std::size_t{1} << 28);
    }
    return files;
}

}  // namespace sonarsim::test
