#include "preview/preview.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "assembly/engine_at.h"
#include "core/units.h"
#include "preview/drawing.h"
#include "preview/scene_views.h"
#include "preview/sonar_panel.h"
#include "sonar/engine_settings.h"
#include "sonar/kinds.h"
#include "sonar/sonar_at_pose.h"
#include "visibility/make_engine.h"

namespace sonarsim {

namespace {

constexpr int tile_width = 600;
constexpr int tile_height = 420;
constexpr int gap = 12;
constexpr int head_height = 30;
constexpr int title_height = 18;

constexpr std::array<Rgb, 6> sonar_colours{{{255, 196, 84},
                                            {120, 205, 235},
                                            {242, 120, 160},
                                            {160, 226, 110},
                                            {196, 160, 250},
                                            {250, 150, 90}}};

struct Tile {
    std::string title;
    Rgb colour;
    Picture picture;
};

/// The font draws a small m as the sign of the metre, which a name must not contain.
std::string capitals(std::string text) {
    for (char& letter : text) {
        if (letter == 'm') letter = 'M';
    }
    return text;
}

std::string head_text(const Mission& mission, const Trajectory& trajectory, std::uint32_t pose) {
    const TimedPose& now = trajectory[pose];
    const Eigen::Vector3d& at = now.T_world_vehicle.translation;
    const Eigen::Vector3d bow = now.T_world_vehicle.rotation * Eigen::Vector3d::UnitX();
    return fmt::format(
        "{}   ping {} of 0 to {}   t = {:.2f} s   x = {:.2f} m   y = {:.2f} m   z = {:.2f} m   "
        "yaw = {:.1f} deg",
        capitals(mission.name), pose, trajectory.size() - 1, now.t_s, at.x(), at.y(), at.z(),
        degrees(std::atan2(bow.y(), bow.x())));
}

std::string title_of(const Sonar& sonar, std::uint32_t pose, double white) {
    const View& view = sonar.settings.view;
    return fmt::format("{}   ping {}   {:.3g} - {:.3g} m   {} x {} bins   white = {:.3g}",
                       capitals(sonar.config.name + ": " + std::string(name_of(sonar.config.kind))),
                       ping_at(sonar, pose), view.range_min_m, view.range_max_m, view.range_bins,
                       view.beams, white);
}

/// `engine: auto` becomes the rays, since trying the engines takes longer than the few pings of a
/// preview.
EngineSettings settings_of_preview(const Mission& mission) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type == EngineKind::automatic) settings.type = EngineKind::rays;
    return settings;
}

/// Limits the sampling to what the picture can show.
Sonar coarse(Sonar sonar) {
    constexpr double coarse_l1 = 0.1;
    View& view = sonar.settings.view;
    view.relative_l1 = std::max(view.relative_l1, coarse_l1);
    return sonar;
}

/// The number of tiles in each row.
Picture arrange(const std::string& head, const std::vector<Tile>& tiles) {
    const int columns = tiles.size() > 6 ? 3 : 2;
    const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
    const int step_x = tile_width + gap;
    const int step_y = title_height + tile_height + gap;
    Picture picture(gap + columns * step_x, head_height + rows * step_y, backdrop);
    write(picture, gap, 12, head, Align::left, ink);
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        const Tile& tile = tiles[k];
        const int x = gap + static_cast<int>(k) % columns * step_x;
        const int y = head_height + static_cast<int>(k) / columns * step_y;
        fill(picture, x, y + 1, 7, 7, tile.colour);
        write(picture, x + 12, y + 1, tile.title, Align::left, ink);
        paste(picture, tile.picture, x + (tile_width - tile.picture.width) / 2, y + title_height);
    }
    return picture;
}

}  // namespace

Picture draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose) {
    const Trajectory& trajectory = assembly.trajectory;
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(assembly.scene, settings_of_preview(mission));
    const auto at_pose = [&](std::uint32_t index) {
        return engine_at(*engine, assembly.motions, trajectory[index].t_s);
    };
    std::vector<Tile> tiles;
    Moment moment{assembly, pose, {}};
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        const Sonar sonar = coarse(assembly.sonars[i]);
        const Rgb colour = sonar_colours[i % sonar_colours.size()];
        const auto render = [&](std::uint32_t index) {
            const SonarAtPose then(mission, sonar, index);
            return render_ping(*then, assembly.scene, *at_pose(index),
                               trajectory[index].T_world_vehicle, {mission.seed, index});
        };
        SonarPanel panel =
            draw_sonar(sonar, pose, trajectory.size(), render, tile_width, tile_height);
        tiles.push_back({title_of(sonar, pose, panel.white), colour, std::move(panel.picture)});
        const std::uint32_t ping = ping_at(sonar, pose);
        moment.beams.push_back(
            beam_outline(sonar, *at_pose(ping),
                         sensor_pose(sonar, trajectory[ping].T_world_vehicle, ping), colour));
    }
    tiles.push_back({"plan: x to the right, y up, colours: height", ink,
                     draw_plan(moment, tile_width, tile_height)});
    tiles.push_back({"cut along the heading: ahead to the right, z up", ink,
                     draw_section(moment, false, tile_width, tile_height)});
    tiles.push_back({"cut across the heading: starboard to the right, z up", ink,
                     draw_section(moment, true, tile_width, tile_height)});
    return arrange(head_text(mission, trajectory, pose), tiles);
}

}  // namespace sonarsim
