#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "assembly/placed_files.h"
#include "checks/find_warnings.h"
#include "core/text.h"
#include "scene/copies.h"
#include "scene/unit_question.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_questions = 3;

/// The unit in which the mission reads an instance; `is_object` for named and scattered objects.
struct Reading {
    LengthUnit units;
    bool is_object;
};

Reading reading_of(const SceneConfig& scene, const std::string& instance) {
    for (const ObjectConfig& object : scene.objects) {
        if (object.name == instance) return {object.mesh.units, true};
    }
    for (const ScatterConfig& scatter : scene.scatter) {
        const std::string start = scatter.name + "_";
        if (instance.starts_with(start) && parse_unsigned(instance.substr(start.size())))
            return {scatter.mesh.units, true};
    }
    return {scene.mesh.units, false};
}

/// "; 'tyre' is 650 m long: millimetres? units: mm" for what the mission may read in a wrong unit.
std::string unit_questions(const Mission& mission, const Scene& scene) {
    const double range_m = farthest_range_m(mission);
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_instances(scene);
    std::vector<std::string> found;
    const auto ask = [&](const std::string& title, const Eigen::AlignedBox3d& box, LengthUnit units,
                         double ranges) {
        if (box.isEmpty()) return;
        const std::string question =
            unit_question(box.sizes().maxCoeff(), metres(units), range_m, ranges);
        if (!question.empty()) found.push_back("; " + title + " is " + question);
    };
    Eigen::AlignedBox3d place;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::string& name = scene.instances[i];
        const Reading reading = reading_of(mission.scene, name);
        if (name == heightmap_instance && mission.scene.heightmap) continue;
        if (name.starts_with(seabed_instance) && mission.scene.seabed) continue;
        if (!reading.is_object)
            place.extend(boxes[i]);
        else
            ask("'" + printable(name) + "'", boxes[i], reading.units, long_object);
    }
    ask("the scene", place, mission.scene.mesh.units, long_place);
    std::string out;
    for (std::size_t i = 0; i < std::min(found.size(), most_questions); ++i)
        out += found[i];
    return out;
}

/// "; heights in bed.tif are all above 0 ..." where a heightmap may hold depths.
std::string depth_question(const Mission& mission, const Scene& scene) {
    const auto& map = mission.scene.heightmap;
    if (!map || map->height_scale < 0.0) return "";
    const auto found = std::ranges::find(scene.instances, heightmap_instance);
    if (found == scene.instances.end()) return "";
    const auto box =
        boxes_of_instances(scene)[static_cast<std::size_t>(found - scene.instances.begin())];
    if (box.isEmpty() || box.min().z() <= 0.0) return "";
    return "; the heights of " + map->file.filename().string() +
           " are all above 0: are they depths? write scene.heightmap.height_scale: -" +
           number_text(map->height_scale);
}

void ask_for_depths(const Mission& mission, const Scene& scene, std::vector<Warning>& warnings) {
    std::string question;
    for (Warning& warning : warnings) {
        if (warning.code != WarningCode::below_surface &&
            warning.code != WarningCode::looks_elsewhere &&
            warning.code != WarningCode::nothing_near)
            continue;
        if (question.empty()) question = depth_question(mission, scene);
        warning.cure += question;
    }
}

}  // namespace

void ask_for_units(const Mission& mission, const Scene& scene, std::vector<Warning>& warnings) {
    ask_for_depths(mission, scene, warnings);
    constexpr std::array asking{WarningCode::scene_out_of_scale, WarningCode::blind,
                                WarningCode::nothing_near};
    const auto asks = [&](const Warning& warning) {
        return std::ranges::find(asking, warning.code) != asking.end();
    };
    if (std::ranges::none_of(warnings, asks)) return;
    const std::string questions = unit_questions(mission, scene);
    for (Warning& warning : warnings) {
        if (asks(warning)) warning.cure += questions;
    }
}

}  // namespace sonarsim
