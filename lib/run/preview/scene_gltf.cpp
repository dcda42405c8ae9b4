#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <sstream>

#include "input/scene/model_data.h"
#include "run/preview/preview.h"

namespace sonarsim {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

constexpr Rgb class_colours[] = {{222, 184, 104}, {112, 178, 214}, {214, 112, 134},
                                 {132, 196, 110}, {178, 138, 220}, {226, 142, 84},
                                 {104, 200, 180}, {206, 206, 110}};
constexpr Rgb background_colour{136, 140, 146};
constexpr Rgb line_colour{255, 255, 255};

/// The glTF file that is made.
class SceneModel {
  public:
    explicit SceneModel(const Assembly& assembly) : assembly_(assembly), scene_(assembly.scene) {
        model_.asset.version = "2.0";
        model_.asset.generator = "sonarsim";
        // From z up to y up: a quarter turn about x.
        const double half = std::sqrt(0.5);
        tinygltf::Node& world = add_node(model_, "z up, metres", -1);
        world.rotation = {-half, 0.0, 0.0, half};
        world.translation = {scene_.origin.x(), scene_.origin.z(), -scene_.origin.y()};
        model_.scenes.emplace_back().nodes = {0};
        model_.defaultScene = 0;
    }

    void add_fixed_surfaces() {
        std::vector<std::vector<Triangle>> by_instance(scene_.instances.size());
        for (std::size_t k = 0; k < scene_.triangles.size(); ++k)
            by_instance[scene_.triangle_instance[k]].push_back(scene_.triangles[k]);
        for (std::uint32_t k = 0; k < by_instance.size(); ++k) {
            if (!by_instance[k].empty())
                place(k, surface(scene_.vertices, by_instance[k], k), Affine3d::Identity());
        }
    }

    void add_copies() {
        std::map<std::pair<std::uint32_t, int>, int> meshes;
        for (const MeshCopy& copy : scene_.copies) {
            const SharedMesh& shared = scene_.shared_meshes[copy.mesh];
            const auto [at, is_new] =
                meshes.try_emplace({copy.mesh, material_of(copy.instance)}, -1);
            if (is_new) at->second = surface(shared.vertices, shared.triangles, copy.instance);
            place(copy.instance, at->second, from_origin(copy.T_world_mesh));
        }
    }

    void add_bodies(const std::vector<Pose>& poses) {
        for (std::size_t k = 0; k < poses.size(); ++k) {
            const Body& body = scene_.bodies[k];
            Affine3d at(poses[k].rotation);
            at.pretranslate(poses[k].translation);
            place(body.instance, surface(body.vertices, body.triangles, body.instance),
                  from_origin(at));
        }
    }

    /// `mode`: tinygltf's constant of lines.
    void add_lines(const std::string& name, const std::vector<Vector3d>& points, int mode,
                   const Rgb& colour) {
        std::vector<Vector3f> local;
        local.reserve(points.size());
        for (const Vector3d& point : points)
            local.emplace_back((point - scene_.origin).cast<float>());
        const int mesh = add_mesh(model_, name);
        tinygltf::Primitive lines;
        lines.mode = mode;
        lines.attributes["POSITION"] = positions_of(local);
        lines.material = material(name, colour);
        model_.meshes.back().primitives.push_back(std::move(lines));
        child(name, mesh);
    }

    std::string bytes() {
        std::ostringstream out;
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, true);
        return std::move(out).str();
    }

  private:
    Affine3d from_origin(Affine3d at) const { return at.pretranslate(-scene_.origin); }

    int positions_of(const std::vector<Vector3f>& vertices) {
        std::vector<float> numbers;
        Eigen::AlignedBox3f box;
        for (const Vector3f& vertex : vertices) {
            numbers.insert(numbers.end(), {vertex.x(), vertex.y(), vertex.z()});
            box.extend(vertex);
        }
        const int at = add_positions(model_, numbers);
        model_.accessors.back().minValues.assign(box.min().begin(), box.min().end());
        model_.accessors.back().maxValues.assign(box.max().begin(), box.max().end());
        return at;
    }

    /// A new mesh of triangles of an instance, with the vertices that they have.
    int surface(std::span<const Vector3f> vertices, std::span<const Triangle> triangles,
                std::uint32_t instance) {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::map<std::uint32_t, std::uint32_t> numbers;
        std::vector<Vector3f> used;
        std::vector<std::uint32_t> corners;
        for (const Triangle& triangle : triangles) {
            for (const std::uint32_t corner : triangle) {
                std::uint32_t& number = numbers.try_emplace(corner, none).first->second;
                if (number == none) {
                    number = static_cast<std::uint32_t>(used.size());
                    used.push_back(vertices[corner]);
                }
                corners.push_back(number);
            }
        }
        const int mesh = add_mesh(model_, scene_.instances[instance]);
        add_triangles(model_, mesh, positions_of(used), corners, material_of(instance));
        return mesh;
    }

    int material(const std::string& name, const Rgb& colour) {
        const auto before = model_.materials.size();
        const int at = material_number(model_, name);
        if (model_.materials.size() == before) return at;
        tinygltf::Material& added = model_.materials.back();
        added.doubleSided = true;
        added.pbrMetallicRoughness.metallicFactor = 0.0;
        added.pbrMetallicRoughness.baseColorFactor = {colour.r / 255.0, colour.g / 255.0,
                                                      colour.b / 255.0, 1.0};
        return at;
    }

    int material_of(std::uint32_t instance) {
        const SceneObjects& objects = assembly_.objects;
        if (objects.objects.empty()) return material("scene", background_colour);
        const std::uint32_t object = objects.object_of(instance);
        const std::uint32_t number = objects.class_of(object);
        return material(objects.classes[number],
                        objects.is_background(object)
                            ? background_colour
                            : class_colours[number % std::size(class_colours)]);
    }

    tinygltf::Node& child(const std::string& name, int mesh) {
        model_.nodes.front().children.push_back(static_cast<int>(model_.nodes.size()));
        return add_node(model_, name, mesh);
    }

    void place(std::uint32_t instance, int mesh, const Affine3d& at) {
        tinygltf::Node& node = child(scene_.instances[instance], mesh);
        const Eigen::Matrix4d& matrix = at.matrix();
        if (!matrix.isIdentity()) node.matrix.assign(matrix.data(), matrix.data() + 16);
        const SceneObjects& objects = assembly_.objects;
        if (objects.objects.empty()) return;
        const SceneObjects::Object& object = objects.objects[objects.object_of(instance)];
        node.extras = tinygltf::Value(tinygltf::Value::Object{
            {"object", tinygltf::Value(object.name)},
            {"class", tinygltf::Value(objects.classes[object.class_index])}});
    }

    const Assembly& assembly_;
    const Scene& scene_;
    tinygltf::Model model_;
};

}  // namespace

std::string scene_gltf(const Assembly& assembly, std::uint32_t pose,
                       const std::vector<BeamOutline>& beams) {
    SceneModel model(assembly);
    model.add_fixed_surfaces();
    model.add_copies();
    model.add_bodies(body_poses(assembly, assembly.trajectory[pose].t_s));
    std::vector<Vector3d> path;
    for (const TimedPose& at : assembly.trajectory)
        path.push_back(at.T_world_vehicle.translation);
    model.add_lines("trajectory", path, TINYGLTF_MODE_LINE_STRIP, line_colour);
    for (std::size_t k = 0; k < beams.size(); ++k) {
        const BeamOutline& beam = beams[k];
        std::vector<Vector3d> edges;
        for (std::size_t at = 0; at < beam.ends.size(); ++at) {
            edges.insert(edges.end(), {beam.ends[at], beam.ends[(at + 1) % beam.ends.size()]});
            if (at % 12 == 0) edges.insert(edges.end(), {beam.origin, beam.ends[at]});
        }
        model.add_lines("view of " + assembly.sonars[k].config.name, edges, TINYGLTF_MODE_LINE,
                        beam.colour);
    }
    return model.bytes();
}

}  // namespace sonarsim
