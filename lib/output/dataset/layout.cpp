#include "output/dataset/layout.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <regex>

#include "output/dataset/seabed_files.h"

namespace sonarsim {

std::string journal_part(int shard, int shards) {
    return std::to_string(shard) + "-of-" + std::to_string(shards) + ".txt";
}

std::vector<std::filesystem::path> journal_parts(const std::filesystem::path& folder) {
    static const std::regex name_of_part("[1-9][0-9]*-of-[1-9][0-9]*\\.txt");
    std::vector<std::filesystem::path> parts;
    const std::filesystem::path parts_folder = folder / journal_folder_name;
    std::error_code error;
    std::error_code absent;
    for (std::filesystem::directory_iterator part(parts_folder, error), end; part != end;
         part.increment(error)) {
        const bool regular =
            part->symlink_status(absent).type() == std::filesystem::file_type::regular;
        if (regular && std::regex_match(part->path().filename().string(), name_of_part))
            parts.push_back(part->path());
    }
    if (error && error != std::errc::no_such_file_or_directory &&
        error != std::errc::not_a_directory)
        throw std::filesystem::filesystem_error("cannot read", parts_folder, error);
    return parts;
}

std::string Layout::number(std::uint32_t pose) const {
    return fmt::format("{:0{}}", pose, digits);
}

std::filesystem::path Layout::sensor_folder(std::size_t sensor) const {
    return folder / sensors[sensor].name;
}

std::filesystem::path Layout::file(const PingId& ping, const PingFile& kind) const {
    return sensor_folder(ping.sensor) / kind.name / number(ping.pose).append(kind.extension);
}

std::size_t Layout::record_of(const PingId& ping) const {
    return ping.pose / sensors[ping.sensor].every;
}

std::vector<std::filesystem::path> Layout::folders() const {
    std::vector<std::filesystem::path> all{folder / journal_folder_name};
    for (const std::string& product : products) {
        const std::filesystem::path parent = (folder / product).parent_path();
        if (std::ranges::find(all, parent) == all.end()) all.push_back(parent);
    }
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        all.push_back(sensor_folder(i));
        for (const Writer& writer : sensors[i].writers) {
            if (const auto* file = std::get_if<PingFile>(&writer.per_ping))
                all.push_back(sensor_folder(i) / file->name);
        }
    }
    return all;
}

Layout make_layout(const Mission& mission, std::vector<Writers> writers, std::size_t poses) {
    Layout layout;
    layout.folder = mission.output.folder;
    for (std::size_t i = 0; i < writers.size(); ++i) {
        const SonarConfig& config = mission.sensors[i];
        layout.sensors.push_back({.name = config.name,
                                  .every = static_cast<std::uint32_t>(config.every),
                                  .pings = count_pings(config, poses),
                                  .writers = std::move(writers[i])});
    }
    if (mission.scene.seabed) layout.products = seabed_file_names();
    if (mission.vehicle.navigation != NavigationConfig{})
        layout.products.emplace_back(navigation_name);
    layout.poses = poses;
    const std::size_t last = poses > 0 ? poses - 1 : 0;
    layout.digits = std::max(6, static_cast<int>(std::to_string(last).size()));
    return layout;
}

std::vector<PingId> list_pings(const Mission& mission, std::size_t poses) {
    std::vector<PingId> pings;
    for (std::uint32_t pose = 0; pose < poses; ++pose) {
        for (std::uint32_t sensor = 0; sensor < mission.sensors.size(); ++sensor) {
            if (pose % mission.sensors[sensor].every == 0) pings.push_back({pose, sensor});
        }
    }
    return pings;
}

}  // namespace sonarsim
