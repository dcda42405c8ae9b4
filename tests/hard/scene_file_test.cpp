#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/file.h"
#include "core/pose.h"
#include "scene/gltf/builder.h"
#include "support/sanitized.h"
#include "hard/tools.h"

using namespace sonarsim;
using nlohmann::json;
namespace fs = std::filesystem;

// The transforms of the hard cases on real glTF files: the tank of the repository, under a node
// that places it elsewhere.

TEST_SUITE_BEGIN("hard");

namespace {

const fs::path scenes = fs::path(SONARSIM_SOURCE_DIR) / "scenes";

/// scenes/tank.glb in parts. All of its positions are floats in nodes without a transform.
struct TankFile {
    json document;
    std::string binary;

    TankFile() {
        const std::string bytes = read_file(scenes / "tank.glb", 1 << 20);
        std::uint32_t json_bytes = 0;
        std::memcpy(&json_bytes, bytes.data() + 12, 4);
        document = json::parse(bytes.substr(20, json_bytes));
        binary = bytes.substr(20 + json_bytes + 8);
    }

    /// Puts all of the scene under one node.
    void wrap(json node) {
        node["name"] = "wrap";
        node["children"] = document["scenes"][0]["nodes"];
        document["nodes"].push_back(node);
        document["scenes"][0]["nodes"] = {document["nodes"].size() - 1};
    }

    /// Changes every position, in the file's axes.
    template <class Change>
    void change_positions(Change change) {
        for (const json& mesh : document["meshes"]) {
            json& accessor =
                document["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<int>()];
            accessor.erase("min");
            accessor.erase("max");
            const json& view = document["bufferViews"][accessor["bufferView"].get<int>()];
            char* const at = binary.data() + view["byteOffset"].get<std::size_t>();
            for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
                Eigen::Vector3f p;
                std::memcpy(p.data(), at + 12 * i, 12);
                p = change(p);
                std::memcpy(at + 12 * i, p.data(), 12);
            }
        }
    }

    Scene load() const {
        const TemporaryFolder folder;
        return load_scene(folder.write("tank.glb", glb_of(document.dump(), binary)),
                          scenes / "materials.csv", Water{});
    }
};

/// glTF is y up: (x, y, z) of the world is (x, z, -y) of the file.
json in_file(double x, double y, double z) {
    return {x, z, -y};
}

/// The node that moves the scene by `motion` in the world. The axis of a rotation transforms as a
/// vector.
json node_of(const Pose& motion) {
    const Eigen::Quaterniond& q = motion.rotation;
    const Eigen::Vector3d& t = motion.translation;
    json rotation = in_file(q.x(), q.y(), q.z());
    rotation.push_back(q.w());
    return {{"translation", in_file(t.x(), t.y(), t.z())}, {"rotation", rotation}};
}

/// The largest errors of the four sonars after scene and trajectory have both moved.
struct Apart {
    double largest = 0.0;   ///< largest difference of a pixel
    double relative = 0.0;  ///< sum |A - B| / sum B
};

Apart compare(const Scene& moved, const Pose& motion, EngineKind engine) {
    const Scene plain = TankFile().load();
    Apart worst;
    for (const SonarKind kind :
         {SonarKind::imaging, SonarKind::profiling, SonarKind::sidescan, SonarKind::echosounder}) {
        const HardTrial home = in_tank(kind);
        const HardTrial away{home.sonar, motion * home.T_world_vehicle};
        const std::vector<float> expected = image_of(plain, home, engine);
        const std::vector<float> found = image_of(moved, away, engine);
        double sum = 0.0;
        double total = 0.0;
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const double apart = std::fabs(static_cast<double>(found[k]) - expected[k]);
            worst.largest = std::max(worst.largest, apart);
            sum += apart;
            total += expected[k];
        }
        REQUIRE(total > 0.0);
        worst.relative = std::max(worst.relative, sum / total);
    }
    return worst;
}

void check(const std::string& what, const Scene& moved, const Pose& motion, EngineKind engine,
           const Apart& bound) {
    const Apart apart = compare(moved, motion, engine);
    MESSAGE(what << ": largest difference of a pixel " << apart.largest << ", relative "
                 << apart.relative);
    CHECK(apart.largest <= bound.largest);
    CHECK(apart.relative <= bound.relative);
}

const Pose nowhere{Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()};

}  // namespace

TEST_CASE("glTF scene under a node at UTM coordinates: the image at the origin") {
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(500000.0, 4800000.0, 0.0), utm_odd}) {
        const Pose motion{Eigen::Quaterniond::Identity(), at};
        TankFile file;
        file.wrap({{"translation", in_file(at.x(), at.y(), at.z())}});
        const Scene scene = file.load();
        CHECK((scene.bounds_min - at - Eigen::Vector3d(-4, -3, 0)).norm() < 1e-5);
        // The error of a range is some 6e-8 of 10 m, and a bin is 2e-2 m: 3e-5 of an echo may fall
        // into another bin.
        check("UTM", scene, motion, EngineKind::rays, {1e-4, 2e-5});
    }
}

TEST_CASE("glTF scene of millimetres under a node scaled by 1e-3: the same image" *
          doctest::skip(test::sanitized)) {
    TankFile file;
    file.change_positions([](const Eigen::Vector3f& p) { return 1000.0F * p; });
    file.wrap({{"scale", {1e-3, 1e-3, 1e-3}}});
    const Scene scene = file.load();
    CHECK((scene.bounds_max - Eigen::Vector3d(4, 3, 3)).norm() < 1e-5);
    check("millimetres", scene, nowhere, EngineKind::rays, {1e-4, 2e-5});
}

TEST_CASE("glTF scene under a rotated node, and the trajectory with it: the same image" *
          doctest::skip(test::sanitized)) {
    const Pose motion{rotation_from_rpy(0.3, -0.2, 1.1), {20.0, -7.0, 3.0}};
    TankFile file;
    file.wrap(node_of(motion));
    const Scene scene = file.load();
    check("rotated", scene, motion, EngineKind::rays, {1e-3, 1e-4});
}

TEST_CASE("glTF vertices at UTM coordinates are off by up to 0.25 m, and the scene says so") {
    // Northings of 4.8e6 m lie between 2^22 and 2^23, where floats are half a metre apart.
    TankFile file;
    file.change_positions([](const Eigen::Vector3f& p) -> Eigen::Vector3f {
        return p + Eigen::Vector3f(500000.0F, 0.0F, -4800000.0F);
    });
    const Scene scene = file.load();
    CHECK(scene.vertex_rounding_m == 0.25);
    CHECK(has_coarse_vertices(scene));
    const Pose motion{Eigen::Quaterniond::Identity(), {500000.0, 4800000.0, 0.0}};
    const Apart apart = compare(scene, motion, EngineKind::rays);
    MESSAGE("vertices at UTM, rays: relative " << apart.relative);
    CHECK(apart.relative > 0.1);
    // The unit of the file makes no difference.
    for (json& node : file.document["nodes"])
        node["scale"] = {16.0, 16.0, 16.0};
    file.change_positions([](const Eigen::Vector3f& p) -> Eigen::Vector3f { return p / 16.0F; });
    CHECK(file.load().vertex_rounding_m == 0.25);
}

TEST_CASE("glTF vertices are fine where only the node is far away, or the scene is large") {
    TankFile file;
    file.wrap({{"translation", {500000.0, 0.0, -4800000.0}}});
    CHECK(!has_coarse_vertices(file.load()));
    CHECK(file.load().vertex_rounding_m < 3e-7);
    // 50 km across, about its own origin: floats are as coarse as that at any place.
    file.document["nodes"].back()["scale"] = {6250.0, 6250.0, 6250.0};
    CHECK(!has_coarse_vertices(file.load()));
    CHECK(file.load().vertex_rounding_m > 5e-4);
}

TEST_SUITE_END();
