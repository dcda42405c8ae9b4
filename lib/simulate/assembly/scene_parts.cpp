#include "simulate/assembly/scene_parts.h"

#include <cmath>
#include <initializer_list>
#include <variant>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/gltf/load.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/rest.h"
#include "input/scene/placing/scatter.h"
#include "input/scene/placing/standing.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/assembly/poses.h"

namespace sonarsim {

namespace {

/// The bottom that objects rest on, made at its first use and kept in the store.
class LazyBottom {
  public:
    /// `ground` is the placed heightmap or seabed, if the scene has one.
    LazyBottom(const SceneConfig& scene, const std::optional<PlacedFile>& ground,
               SceneStore& models)
        : scene_(scene), ground_(ground), models_(models) {}

    /// True if this object is the bottom.
    bool is(const ObjectConfig& object) const {
        return !is_of_files() && &object == &scene_.objects.front();
    }

    const std::shared_ptr<const Bottom>& share() const {
        if (!bottom_) bottom_ = models_.bottom(file(), nodes());
        return bottom_;
    }
    const Bottom& get() const { return *share(); }

    /// True if there is a bottom that does not move.
    bool exists() const { return is_of_files() || stands_still(scene_.objects.front()); }

    /// Patterns of its nodes; empty: all.
    std::vector<std::string> nodes() const {
        const bool is_bed = is_ground() && ground_->seabed && scene_.bottom.empty();
        return is_bed ? std::vector<std::string>{seabed_instance} : scene_.bottom;
    }

    /// Notes in its file that its nodes are the bottom. `files` are those of SceneParts.
    void mark(std::vector<PlacedFile>& files) const {
        files[is_ground() && !scene_.file.empty() ? 1 : 0].bottom = nodes();
    }

    /// "; 'tyre' is 650 m long: millimetres? units: mm" where an object or the bottom may be in
    /// another unit; "" elsewhere. An object longer than the bottom cannot rest on it.
    std::string unit_questions(const std::string& object, double length_m, const MeshConfig& of,
                               double range_m) const {
        const double bottom_m = get().area().sizes().maxCoeff();
        const MeshConfig& mesh = is_of_files() ? scene_.mesh : scene_.objects.front().mesh;
        std::string out;
        const auto add = [&](const std::string& title, const std::string& question) {
            if (!question.empty()) out += "; " + title + " is " + question;
        };
        add(object, unit_question(length_m, metres(of.units),
                                  std::min(range_m, bottom_m / long_object), long_object));
        if (!ground_)
            add("the bottom", unit_question(bottom_m, metres(mesh.units), range_m, long_place));
        return out;
    }

    /// " from (x, y) to (x, y)", for messages.
    std::string reach() const {
        const auto text = [](const Eigen::Vector2d& p) {
            const auto rounded = [](double x) { return number_text(std::round(1e3 * x) / 1e3); };
            return "(" + rounded(p.x()) + ", " + rounded(p.y()) + ")";
        };
        return " from " + text(get().area().min()) + " to " + text(get().area().max());
    }

  private:
    static bool stands_still(const ObjectConfig& object) {
        return object.place_on != ObjectPlace::on_bottom && !object.trajectory;
    }

    /// True unless objects alone make the scene.
    bool is_of_files() const { return !scene_.file.empty() || ground_; }

    bool is_ground() const { return ground_ && (scene_.bottom.empty() || scene_.file.empty()); }

    PlacedFile file() const {
        if (is_ground()) return *ground_;
        if (!scene_.file.empty()) return file_of(scene_.file, scene_.mesh, scene_.place);
        const ObjectConfig& first = scene_.objects.front();
        if (!stands_still(first)) {
            throw InputError(first.place,
                             "without scene.file the first object is the bottom that others rest "
                             "on: it must neither move nor rest on the bottom itself");
        }
        PlacedFile file = file_of(first);
        file.T_world_file = transform_of(first);
        return file;
    }

    const SceneConfig& scene_;
    const std::optional<PlacedFile>& ground_;
    SceneStore& models_;
    mutable std::shared_ptr<const Bottom> bottom_;  ///< kept from its first use on
};

/// The transform of an object, which may rest on the bottom.
Eigen::Affine3d settled_transform(const ObjectConfig& object, const Surface& shape,
                                  const LazyBottom& bottom, double range_m) {
    if (object.place_on != ObjectPlace::on_bottom) return transform_of(object);
    const auto T_world_file = put_on_bottom(
        bottom.get(), shape, Eigen::Vector2d(object.position_m.data()),
        {rotation_from_degrees(object.rpy_deg), object.scale, object.align, object.bury_m});
    if (T_world_file) return *T_world_file;
    const double length_m = object.scale * box_of(shape).sizes().maxCoeff();
    throw InputError(object.place,
                     title_of(object) + " reaches beyond the bottom, which lies" + bottom.reach() +
                         "; move it by position_m, or place: free" +
                         bottom.unit_questions(title_of(object), length_m, object.mesh, range_m));
}

/// A trajectory of waypoints or lines begins with the first ping; a file has its own times.
Trajectory motion_of(const ObjectConfig& object, const Trajectory& vehicle) {
    if (std::holds_alternative<LookAtTrajectoryConfig>(*object.trajectory)) {
        throw InputError(object.place,
                         title_of(object) + " cannot look at objects: name a file or waypoints");
    }
    const auto* const lines = std::get_if<LawnmowerTrajectoryConfig>(&*object.trajectory);
    if (lines && lines->altitude_m > 0.0)
        throw InputError(object.place, title_of(object) + " has no altitude_m: give z_m");
    Trajectory motion = read_named_at(object.place, [&] { return path_of(*object.trajectory); });
    const double start_s = vehicle.front().t_s;
    const double end_s = vehicle.back().t_s;
    if (!std::holds_alternative<FileTrajectoryConfig>(*object.trajectory)) {
        for (TimedPose& pose : motion)
            pose.t_s += start_s;
    }
    constexpr double rounding_s = 1e-6;
    if (motion.back().t_s < end_s && motion.back().t_s > end_s - rounding_s)
        motion.back().t_s = end_s;
    if (motion.front().t_s <= start_s && motion.back().t_s >= end_s) return motion;
    throw InputError(object.place,
                     title_of(object) + " moves from " + number_text(motion.front().t_s) +
                         " s to " + number_text(motion.back().t_s) +
                         " s and the sonars ping from " + number_text(start_s) + " s to " +
                         number_text(end_s) + " s; let its trajectory last as long");
}

/// True unless an object is turned so far that it is not expected to stand upright in its file.
bool is_upright(std::initializer_list<double> turns_deg) {
    constexpr double max_tilt_deg = 45.0;
    return std::ranges::all_of(turns_deg, [](double x) { return std::abs(x) < max_tilt_deg; });
}

void add_orientation_warning(const std::string& question, SceneParts& parts) {
    if (!question.empty() && !contains(parts.orientation_warnings, question))
        parts.orientation_warnings.push_back(question);
}

/// Scatters objects. Without room the error says where the bottom lies, and asks for the units.
std::vector<ScatteredObject> scattered(const ScatterConfig& config,
                                       std::span<const Surface* const> shapes, std::uint32_t index,
                                       std::uint64_t seed, const LazyBottom& bottom, double range_m,
                                       TakenGround& taken) {
    const Bottom& ground = bottom.get();
    try {
        return scatter(config, shapes, index, seed, ground, taken);
    } catch (const InputError& error) {
        double length_m = 0.0;
        for (const Surface* shape : shapes)
            length_m = std::max(length_m, config.scale[1] * box_of(*shape).sizes().maxCoeff());
        throw InputError(error.what() + ("; the bottom lies" + bottom.reach()) +
                         bottom.unit_questions("'" + printable(config.name) + "'", length_m,
                                               config.mesh, range_m));
    }
}

/// Scatters the objects of one rule and appends their files.
void scatter_files(const ScatterConfig& config, std::uint32_t index, std::uint64_t seed,
                   double range_m, SceneStore& models, const LazyBottom& bottom, TakenGround& taken,
                   SceneParts& parts) {
    std::vector<PlacedFile> kinds;
    std::vector<const Surface*> surfaces;
    for (const std::filesystem::path& path : config.files) {
        kinds.push_back(file_of(path, config.mesh, config.place));
        kinds.back().class_name = config.class_of(kinds.size() - 1);
        surfaces.push_back(&models.shape(kinds.back(), config.mesh));
        if (!surfaces.back()->triangles.empty()) continue;
        throw InputError(config.place, path.string() + " has no surface to scatter");
    }
    const bool upright = is_upright(
        {config.roll_deg[0], config.roll_deg[1], config.pitch_deg[0], config.pitch_deg[1]});
    for (std::size_t i = 0; upright && i < kinds.size(); ++i)
        add_orientation_warning(up_question(kinds[i], *surfaces[i]), parts);
    std::vector<PlacedFile>& files = parts.files;
    std::size_t number = 0;
    for (const ScatteredObject& object :
         scattered(config, surfaces, index, seed, bottom, range_m, taken)) {
        PlacedFile& file = files.emplace_back(kinds[object.shape]);
        file.name = config.name + "_" + std::to_string(++number);
        file.T_world_file = object.T_world_shape;
    }
}

}  // namespace

SceneParts place_scene(const Mission& mission, const Trajectory& vehicle,
                       std::span<const Sonar> sonars, SceneStore& models, bool places_only) {
    const SceneConfig& scene = mission.scene;
    SceneParts parts;
    if (!scene.file.empty()) {
        const PlacedFile& file =
            parts.files.emplace_back(file_of(scene.file, scene.mesh, scene.place));
        if (is_mesh_file(scene.file))
            add_orientation_warning(up_question(file, surface_of(file, models)), parts);
    }
    const auto* const lines = std::get_if<LawnmowerTrajectoryConfig>(&mission.trajectory);
    const bool needs_ground =
        (lines && lines->altitude_m > 0.0) || contains(mission.output.labels, Label::height);
    std::optional<PlacedFile> below_objects =
        needs_ground ? std::nullopt : bed_of_objects(mission, models);
    std::optional<PlacedFile> ground;
    if (!(places_only && below_objects)) ground = ground_of(mission, vehicle, sonars, models);
    if (ground) {
        parts.seabed = ground->seabed;
        parts.files.push_back(*ground);
    }
    const LazyBottom bottom(scene, below_objects ? below_objects : ground, models);
    TakenGround taken;
    const double range_m = farthest_range_m(mission);
    for (const ObjectConfig& object : scene.objects) {
        PlacedFile& file = parts.files.emplace_back(file_of(object));
        const Surface& shape = models.shape(file, object.mesh);
        if (shape.triangles.empty()) {
            throw InputError(object.place, title_of(object) + ": there is no surface in " +
                                               object.file.string() + "; name another file");
        }
        if (is_upright({object.rpy_deg[0], object.rpy_deg[1]}))
            add_orientation_warning(up_question(file, shape), parts);
        file.T_world_file = settled_transform(object, shape, bottom, range_m);
        if (object.trajectory) {
            parts.motions.push_back(motion_of(object, vehicle));
            continue;
        }
        if (bottom.is(object)) continue;
        const Surface placed = moved(shape, file.T_world_file);
        if (bottom.exists() && lies_below(bottom.get(), placed)) {
            refuse(object.place, "{} lies wholly below the bottom; {}", title_of(object),
                   object.place_on == ObjectPlace::free
                       ? "raise it by position_m, or let it rest there with place: on_bottom"
                       : "lower bury_m");
        }
        if (!scene.scatter.empty()) taken.add(hull_of(placed.vertices));
    }
    for (std::size_t i = 0; i < scene.scatter.size(); ++i) {
        scatter_files(scene.scatter[i], static_cast<std::uint32_t>(i), mission.seed, range_m,
                      models, bottom, taken, parts);
    }
    // Reports a pattern of `bottom` that matches no node, even if no object rests on it.
    if (!scene.bottom.empty()) bottom.get();
    if (bottom.exists() && !places_only) bottom.mark(parts.files);
    if (!needs_ground || !bottom.exists()) return parts;
    parts.bottom = bottom.share();
    for (const PlacedFile& file : parts.files) {
        if (!file.name.empty() && contains(bottom.nodes(), file.name)) {
            refuse(file.place, "scene.bottom names a node '{}', too; give the object another name",
                   printable(file.name));
        }
    }
    return parts;
}

}  // namespace sonarsim
