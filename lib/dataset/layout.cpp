#include "dataset/layout.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "dataset/shared_products.h"
#include "format/tar.h"

namespace sonarsim {

namespace {

/// As many as surely fit; 0 where nothing is packed.
std::size_t pings_per_pack(const Mission& mission, std::size_t sensor, const Writers& writers) {
    if (mission.output.pack == Pack::none) return 0;
    double bytes = 0.0;  // of a ping, at most
    for (const auto& writer : writers) {
        const WriterOutputs outputs = writer->outputs();
        if (std::holds_alternative<PingFile>(outputs.per_ping))
            bytes += static_cast<double>(
                tar_bytes(static_cast<std::uint64_t>(std::ceil(outputs.bytes_per_ping))));
    }
    if (bytes == 0.0) return 0;
    constexpr double bytes_of_mb = 1e6;
    const double room = bytes_of_mb * mission.output.pack_size_mb - tar_end_bytes;
    if (room < bytes) {
        throw InputError("output.pack_size_mb is too small: a ping of sensor '" +
                         mission.sensors[sensor].name + "' takes up to " +
                         std::to_string((bytes + tar_end_bytes) / bytes_of_mb) +
                         " MB; give more, the default is 256");
    }
    return static_cast<std::size_t>(room / bytes);
}

}  // namespace

std::string journal_part(int shard, int shards) {
    return std::to_string(shard) + "-of-" + std::to_string(shards) + ".txt";
}

bool is_journal_part(std::string_view name) {
    constexpr std::uint64_t most_shards = 1'000'000;  // as --shard has it
    const std::size_t of = name.find("-of-");
    if (of == std::string_view::npos || !name.ends_with(".txt")) return false;
    const auto shard = parse_unsigned(name.substr(0, of));
    name.remove_suffix(4);
    const auto shards = parse_unsigned(name.substr(of + 4));
    return shard && shards && *shard >= 1 && *shard <= *shards && *shards <= most_shards;
}

std::string Layout::number(std::uint32_t pose) const {
    std::string text = std::to_string(pose);
    text.insert(0, std::max(0, digits - static_cast<int>(text.size())), '0');
    return text;
}

std::filesystem::path Layout::sensor_folder(std::size_t sensor) const {
    return folder / sensors[sensor].name;
}

std::filesystem::path Layout::file(const PingId& ping, const PingFile& kind) const {
    return sensor_folder(ping.sensor) / kind.name / number(ping.pose).append(kind.extension);
}

std::filesystem::path Layout::product_file(std::size_t sensor, const std::string& name) const {
    return (sensor < sensors.size() ? sensor_folder(sensor) : folder) / name;
}

std::size_t Layout::packs(std::size_t sensor) const {
    const std::size_t each = sensors[sensor].pings_per_pack;
    return each > 0 ? (sensors[sensor].pings + each - 1) / each : 0;
}

std::size_t Layout::pack_of(const PingId& ping) const {
    return record_of(ping) / sensors[ping.sensor].pings_per_pack;
}

bool Layout::is_last_in_pack(const PingId& ping) const {
    const SensorLayout& sensor = sensors[ping.sensor];
    const std::size_t next = record_of(ping) + 1;
    return next == sensor.pings || next % sensor.pings_per_pack == 0;
}

std::filesystem::path Layout::pack_file(const PingId& ping) const {
    return sensor_folder(ping.sensor) / pack_folder_name /
           number(static_cast<std::uint32_t>(pack_of(ping))).append(".tar");
}

std::string Layout::member(const PingId& ping, const PingFile& kind) const {
    return sensors[ping.sensor].name + "-" + number(ping.pose) + "." + kind.name + kind.extension;
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
        if (sensors[i].pings_per_pack > 0) {
            all.push_back(sensor_folder(i) / pack_folder_name);
            continue;
        }
        for (const auto& part : sensors[i].per_ping) {
            if (const auto* file = std::get_if<PingFile>(&part))
                all.push_back(sensor_folder(i) / file->name);
        }
    }
    return all;
}

Layout make_layout(const Mission& mission, const std::vector<Writers>& writers, std::size_t poses) {
    const std::vector<std::size_t> pings = count_pings(mission, poses);
    Layout layout;
    layout.folder = mission.output.folder;
    for (std::size_t i = 0; i < writers.size(); ++i) {
        const SonarConfig& config = mission.sensors[i];
        SensorLayout sensor{.name = config.name,
                            .every = static_cast<std::uint32_t>(config.every),
                            .pings = pings[i],
                            .per_ping = {},
                            .products = {},
                            .pings_per_pack = pings_per_pack(mission, i, writers[i])};
        for (const auto& writer : writers[i]) {
            WriterOutputs outputs = writer->outputs();
            sensor.per_ping.push_back(std::move(outputs.per_ping));
            for (Product& product : outputs.products)
                sensor.products.push_back(std::move(product.file));
        }
        layout.sensors.push_back(std::move(sensor));
    }
    for (SharedProduct& product : shared_products(mission))
        layout.products.push_back(std::move(product.file));
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

int shard_of(const Layout& layout, const PingId& ping, std::size_t index, int shards) {
    const bool packed = layout.sensors[ping.sensor].pings_per_pack > 0;
    return static_cast<int>((packed ? layout.pack_of(ping) : index) %
                            static_cast<std::size_t>(shards));
}

}  // namespace sonarsim
