#include "preview/preview.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
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
constexpr int title_height = 20;
constexpr int margin_px = 60;  // for the numbers of a plan

constexpr std::array<Rgb, 6> sonar_colours{{{255, 196, 84},
                                            {120, 205, 235},
                                            {242, 120, 160},
                                            {160, 226, 110},
                                            {196, 160, 250},
                                            {250, 150, 90}}};

struct Tile {
    std::string title;
    Rgb colour;
    Drawing drawing;
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

/// Tiles in each row: at most three, or two if that makes two rows of two. The last rows have
/// fewer, so that no row has a gap.
std::vector<int> tiles_of_rows(int tiles) {
    const int most = tiles > 4 ? 3 : 2;
    const int rows = (tiles + most - 1) / most;
    std::vector<int> counts(static_cast<std::size_t>(rows), tiles / rows);
    for (int row = 0; row < tiles % rows; ++row)
        ++counts[static_cast<std::size_t>(row)];
    return counts;
}

/// The widths of the tiles of a row, which fill `all` pixels. `shapes`: height by width of what
/// each shows; 0: any. A tile with a shape is no wider than needed if another one can take the
/// room, and if all have shapes, they are equally high.
std::vector<int> widths_of_row(std::span<const double> shapes, int all) {
    constexpr double least_share = 0.2;  // share of the row
    all -= static_cast<int>(shapes.size() - 1) * gap;
    const double equal = static_cast<double>(all) / static_cast<double>(shapes.size());
    const auto any = static_cast<double>(std::ranges::count(shapes, 0.0));
    std::vector<double> wanted;
    wanted.reserve(shapes.size());
    double shaped = 0.0;
    for (const double shape : shapes) {
        if (any > 0.0)
            wanted.push_back(shape == 0.0 ? 0.0 : std::min(equal, tile_height / shape + margin_px));
        else
            wanted.push_back(1.0 / shape);
        shaped += wanted.back();
    }
    for (double& width : wanted) {
        if (any > 0.0 && width == 0.0) width = (all - shaped) / any;
        if (any == 0.0) width = std::max(all * width / shaped, least_share * all);
    }
    double sum = 0.0;
    for (const double width : wanted)
        sum += width;
    std::vector<int> widths;
    widths.reserve(wanted.size());
    for (const double width : wanted)
        widths.push_back(static_cast<int>(width * all / sum));
    return widths;
}

std::vector<int> tile_widths(const std::vector<int>& rows, std::span<const double> shapes) {
    const int all = rows.front() * (tile_width + gap) - gap;
    std::vector<int> widths;
    widths.reserve(shapes.size());
    for (const int count : rows) {
        const auto own = static_cast<std::size_t>(count);
        for (const int width : widths_of_row(shapes.subspan(widths.size(), own), all))
            widths.push_back(width);
    }
    return widths;
}

/// The text, cut off where the width ends.
std::string fitting_text(const std::string& text, int width) {
    std::string fits = text;
    while (text_width(fits) > width && fits.size() > 4)
        fits.replace(fits.size() - 4, 4, "...");
    return fits;
}

Drawing arrange(const std::string& head, const std::vector<Tile>& tiles,
                const std::vector<int>& rows, const std::vector<int>& widths) {
    std::vector<int> heights;
    int height = head_height;
    std::size_t first = 0;
    for (const int count : rows) {
        int highest = 0;
        for (std::size_t k = first; k < first + static_cast<std::size_t>(count); ++k)
            highest = std::max(highest, tiles[k].drawing.height);
        heights.push_back(highest);
        height += title_height + highest + gap;
        first += static_cast<std::size_t>(count);
    }
    Drawing all(gap + rows.front() * (tile_width + gap), height, backdrop);
    all.texts.push_back({gap, head_height / 2, fitting_text(head, all.width), Align::left, ink});
    int y = head_height;
    std::size_t k = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        int x = gap;
        for (int column = 0; column < rows[row]; ++column, ++k) {
            const Tile& tile = tiles[k];
            fill(all, x, y + 5, 9, 9, tile.colour);
            all.texts.push_back(
                {x + 16, y + 9, fitting_text(tile.title, widths[k] - 16), Align::left, ink});
            paste(all, tile.drawing, x + (widths[k] - tile.drawing.width) / 2, y + title_height);
            x += widths[k] + gap;
        }
        y += title_height + heights[row] + gap;
    }
    return all;
}

}  // namespace

Picture draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose) {
    const Trajectory& trajectory = assembly.trajectory;
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(assembly.scene, settings_of_preview(mission));
    const auto at_pose = [&](std::uint32_t index) {
        return engine_at(*engine, assembly.motions, trajectory[index].t_s);
    };
    Moment moment{assembly, pose, {}};
    std::vector<Sonar> sonars;
    std::vector<double> shapes;
    sonars.reserve(assembly.sonars.size());
    shapes.reserve(assembly.sonars.size() + 3);
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        sonars.push_back(coarse(assembly.sonars[i]));
        shapes.push_back(0.0);
        const std::uint32_t ping = ping_at(sonars[i], pose);
        const Pose& T_world_vehicle = trajectory[ping].T_world_vehicle;
        moment.beams.push_back(beam_outline(sonars[i], *at_pose(ping),
                                            sensor_pose(sonars[i], T_world_vehicle, ping),
                                            sonar_colours[i % sonar_colours.size()]));
    }
    shapes.push_back(plan_shape(moment));
    shapes.push_back(section_shape(moment, false));
    shapes.push_back(section_shape(moment, true));
    const std::vector<int> rows = tiles_of_rows(static_cast<int>(shapes.size()));
    const std::vector<int> widths = tile_widths(rows, shapes);
    std::vector<Tile> tiles;
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        const auto render = [&](std::uint32_t index) {
            const SonarAtPose then(mission, sonars[i], index);
            return render_ping(*then, assembly.scene, *at_pose(index),
                               trajectory[index].T_world_vehicle, {mission.seed, index});
        };
        SonarPanel panel =
            draw_sonar(sonars[i], pose, trajectory.size(), render, widths[i], tile_height);
        tiles.push_back({title_of(sonars[i], pose, panel.white), moment.beams[i].colour,
                         std::move(panel.picture)});
    }
    tiles.push_back({"plan: x to the right, y up, colours: height", ink,
                     draw_plan(moment, widths[tiles.size()], tile_height)});
    tiles.push_back({"cut along: ahead right", ink,
                     draw_section(moment, false, widths[tiles.size()], tile_height)});
    tiles.push_back({"cut across: starboard right", ink,
                     draw_section(moment, true, widths[tiles.size()], tile_height)});
    Drawing all = arrange(head_text(mission, trajectory, pose), tiles, rows, widths);
    draw_texts(all);
    return all;
}

}  // namespace sonarsim
