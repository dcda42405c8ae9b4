#include "simulate/calibrated/specular_path.h"

#include <cmath>

#include "simulate/calibrated/piece_strengths.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/water_mirror.h"

namespace sonarsim {

namespace {

/// `water` is null for a path without a reflection at the water's surface.
SpecularPath specular_path(const BouncePath& path, const Sample& sample, const WaterMirror* water) {
    const auto reflected = [&](const Eigen::Vector3f& v) -> Eigen::Vector3f {
        return water ? water->reflect_direction(v) : v;
    };
    // As in find_bounces(): the path from the image of the sonar through p_i is straight.
    const Eigen::Vector3f from = 2.0F * sample.normal.dot(sample.position) * sample.normal;
    const Eigen::Vector3f through = sample.position - from;
    const float along = through.dot(path.normal);
    const float t = (path.point - from).dot(path.normal) / along;
    const Eigen::Vector3f p = from + t * through;
    const Eigen::Vector3f sonar = water ? water->image : Eigen::Vector3f(Eigen::Vector3f::Zero());
    const Eigen::Vector3f back = p - sonar;
    const float first_leg = arrival_range(sample.position);
    const float last_leg = arrival_range(back);

    SpecularPath out;
    out.point.at = water ? water->reflect_point(p) : p;
    out.image_source.at = t * sample.position;
    const auto move = [&](const Eigen::Vector3f& edge, Eigen::Vector3f& point_change,
                          Eigen::Vector3f& image_change) {
        const float stretch = -t * edge.dot(path.normal) / along;
        point_change = reflected(t * edge + stretch * through);
        image_change = t * edge + stretch * sample.position;
    };
    move(sample.edge_u, out.point.u, out.image_source.u);
    move(sample.edge_v, out.point.v, out.image_source.v);
    out.sine_of_image = std::fabs(along) / first_leg;
    out.sine_of_point = -path.normal.dot(back) / last_leg;
    const Eigen::Vector3f midway = through / first_leg + back / last_leg;
    out.sine_between = (out.sine_of_image + out.sine_of_point) / midway.norm();
    out.area_m2 = sample.area_m2 * sample.height_m / first_leg * t * t / out.sine_of_image;
    out.material = path.material;
    out.instance = path.instance;
    return out;
}

}  // namespace

std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene,
                                         ViewShape shape) {
    const std::optional<WaterMirror> water = mirror_of(scene.water_surface, traced.T_world_sensor);
    const PieceStrengths strengths(traced, scene, shape);
    std::vector<SpecularPath> paths;
    paths.reserve(traced.bounces.size());
    for (const BouncePath& path : traced.bounces) {
        if (path.material == no_material) continue;
        const Sample& sample = traced.starts().items[path.sample];
        paths.push_back(specular_path(path, sample, path.by_water_surface ? &*water : nullptr));
        paths.back().sample = path.sample;
        paths.back().reflection = scene.materials[sample.material].reflection * sample.strength *
                                  strengths.at(sample) * path.water_reflection * path.strength;
    }
    return paths;
}

}  // namespace sonarsim
