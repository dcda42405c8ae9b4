#include "run/preview/preview.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "core/units.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

namespace {

constexpr int tile_width = 600;
constexpr int tile_height = 420;
constexpr int gap = 12;
constexpr int head_height = 30;
constexpr int title_height = 20;

constexpr Rgb sonar_colours[] = {{255, 196, 84},  {120, 205, 235}, {242, 120, 160},
                                 {160, 226, 110}, {196, 160, 250}, {250, 150, 90}};

struct Tile {
    std::string title;
    Rgb colour;
    Picture picture;
};

std::string head_text(const Mission& mission, const Trajectory& trajectory, std::uint32_t pose) {
    const TimedPose& now = trajectory[pose];
    const Eigen::Vector3d& at = now.T_world_vehicle.translation;
    const Eigen::Vector3d bow = now.T_world_vehicle.rotation * Eigen::Vector3d::UnitX();
    return fmt::format(
        "{}   ping {} of 0 to {}   t = {:.2f} s   x = {:.2f} m   y = {:.2f} m   z = {:.2f} m   "
        "yaw = {:.1f} deg",
        mission.name, pose, trajectory.size() - 1, now.t_s, at.x(), at.y(), at.z(),
        degrees(std::atan2(bow.y(), bow.x())));
}

std::string title_of(const Sonar& sonar, std::uint32_t pose, double white) {
    const View& view = sonar.settings.view;
    // A title that is too long loses its end, which is in the mission.
    return fmt::format("{}   ping {}   {:.3g} - {:.3g} m   white = {:.3g}   {} x {} bins",
                       sonar.config.name + ": " + std::string(name_of(sonar.config.kind)),
                       ping_at(sonar, pose), view.range_min_m, view.range_max_m, white,
                       view.range_bins, view.beams);
}

/// The text, cut off where the width ends.
std::string fitting_text(const std::string& text, int width) {
    std::string fits = text;
    while (text_width(fits) > width && fits.size() > 4)
        fits.replace(fits.size() - 4, 4, "...");
    return fits;
}

/// Puts the tiles into rows of three, or of two if there are at most four.
Picture arrange(const std::string& head, const std::vector<Tile>& tiles) {
    const std::size_t columns = tiles.size() > 4 ? 3 : std::min<std::size_t>(tiles.size(), 2);
    const std::size_t rows = (tiles.size() + columns - 1) / columns;
    constexpr int row_height = title_height + tile_height + gap;
    Picture all(gap + static_cast<int>(columns) * (tile_width + gap),
                head_height + static_cast<int>(rows) * row_height, backdrop);
    label(all, gap, head_height / 2, fitting_text(head, all.width), Align::left);
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        const Tile& tile = tiles[k];
        const int x = gap + static_cast<int>(k % columns) * (tile_width + gap);
        const int y = head_height + static_cast<int>(k / columns) * row_height;
        fill(all, x, y + 5, 9, 9, tile.colour);
        label(all, x + 16, y + 9, fitting_text(tile.title, tile_width - 16), Align::left);
        paste(all, tile.picture, x + (tile_width - tile.picture.width) / 2, y + title_height);
    }
    return all;
}

}  // namespace

Preview draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose) {
    const Trajectory& trajectory = assembly.trajectory;
    EngineSettings settings = engine_settings(mission);
    // `auto` chooses by the views of the mission, and a preview has coarser ones.
    if (settings.type == EngineKind::automatic) settings.type = EngineKind::rays;
    const std::unique_ptr<VisibilityEngine> engine = make_engine(assembly.scene, settings);
    const auto at_pose = [&](std::uint32_t index) {
        return engine_at(*engine, assembly.motions, trajectory[index].t_s);
    };
    const std::shared_ptr<const VisibilityEngine> now = at_pose(pose);
    Moment moment{assembly, *now, pose, {}};
    std::vector<Tile> tiles;
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        Sonar sonar = assembly.sonars[i];
        double& goal = sonar.settings.view.relative_l1;
        goal = std::max(goal, 0.1);  // the picture shows no more
        const Rgb colour = sonar_colours[i % std::size(sonar_colours)];
        const std::uint32_t ping = ping_at(sonar, pose);
        const Pose& T_world_vehicle = trajectory[ping].T_world_vehicle;
        moment.beams.push_back(
            beam_outline(sonar, *at_pose(ping), sensor_pose(sonar, T_world_vehicle, ping), colour));
        const auto render = [&](std::uint32_t index) {
            const SonarAtPose then(mission, sonar, index);
            return render_ping(*then, assembly.scene, *at_pose(index),
                               trajectory[index].T_world_vehicle, {mission.seed, index});
        };
        SonarPanel panel =
            draw_sonar(sonar, pose, trajectory.size(), render, tile_width, tile_height);
        tiles.push_back({title_of(sonar, pose, panel.white), colour, std::move(panel.picture)});
    }
    tiles.push_back({"plan: x to the right, y up, colours: height", ink,
                     draw_plan(moment, tile_width, tile_height)});
    return {arrange(head_text(mission, trajectory, pose), tiles), std::move(moment.beams)};
}

}  // namespace sonarsim
