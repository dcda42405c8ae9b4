#include <cmath>

#include "input/trajectory/trajectory.h"
#include "target.h"

// The first byte chooses the reader: 't' for TUM, anything else for CSV. What a reader accepts must
// keep the promises of Trajectory and survive writing, reading and resampling.

using namespace sonarsim;

namespace {

void check_poses(const Trajectory& poses) {
    require(!poses.empty());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        require(std::isfinite(poses[i].t_s));
        require(i == 0 || poses[i].t_s > poses[i - 1].t_s);
        require(poses[i].T_world_vehicle.translation.allFinite());
        require(std::fabs(poses[i].T_world_vehicle.rotation.norm() - 1.0) < 1e-14);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text = text_of(data + 1, size - 1);
    Trajectory poses;
    try {
        poses = data[0] == 't' ? parse_tum(text, "in.tum") : parse_csv_trajectory(text, "in.csv");
    } catch (const InputError&) {
        return 0;
    }
    check_poses(poses);
    const std::string written = write_tum(poses);
    const Trajectory again = parse_tum(written, "again.tum");
    require(again.size() == poses.size() && write_tum(again) == written);
    const double duration = poses.back().t_s - poses.front().t_s;
    // Times may lie too close together for the rate.
    return read_or_refuse(
        [&] { check_poses(resample(poses, duration > 0.0 ? 7.0 / duration : 1.0)); });
}
