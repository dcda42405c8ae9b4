#include "simulate/calibrated/equation/specular_echoes.h"

#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/visible_water_surface.h"

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

/// The ends of a block of paths: the pieces, or their images.
struct Ends {
    PatchBlock places;
    PointEchoes echoes;                  ///< ranges of the places; use_block() fills the rest
    PatchBlock::Array<float> sent = {};  ///< share of the power that is sent towards them
};

struct PiecesOfPaths {
    int count = 0;
    Ends points, images;
    PatchBlock::Array<float> power{}, row{};
    PatchBlock::Array<std::uint32_t> path{};
};

using UseBlock = std::function<void(const SpecularBlock&)>;

void put_place(Ends& ends, int k, const SpecularPath::Place& place, float s, float t) {
    const Eigen::Vector3f p = place.at + s * place.u + t * place.v;
    ends.places.x[k] = p.x();
    ends.places.y[k] = p.y();
    ends.places.z[k] = p.z();
    ends.echoes.range_m[k] = arrival_range(p);
}

/// Finds the power that is transmitted towards the ends.
void direct_ends(Ends& ends, int count, const SineTable& pattern) {
    ends.places.count = count;
    ends.echoes.count = count;
    ends.echoes.power.fill(1.0F);
    weigh_by_elevation(pattern, ends.places, count, ends.echoes);
    ends.sent = ends.echoes.power;
}

/// The echoes that go out to some ends and return from the others.
void use_reciprocal_path(const PiecesOfPaths& block, const Ends& out, Ends& back,
                         const UseBlock& use) {
    for (int k = 0; k < block.count; ++k) {
        back.echoes.power[k] = block.power[k] * out.sent[k];
        back.echoes.row[k] = block.row[k];
    }
    use({.out = {out.places, out.echoes},
         .places = back.places,
         .echoes = back.echoes,
         .path = std::span(block.path).first(block.count)});
}

std::uint64_t use_block(const SonarEquation& equation, PiecesOfPaths& block, const UseBlock& use) {
    direct_ends(block.points, block.count, equation.elevation);
    direct_ends(block.images, block.count, equation.elevation);
    std::uint64_t outside = 0;
    const auto rows = static_cast<float>(equation.rows);
    for (int k = 0; k < block.count; ++k) {
        const float r = block.points.echoes.range_m[k];
        const float s = block.images.echoes.range_m[k];
        const float range = arrival_range(r, s);
        const float row = (range - equation.range_min_m) / equation.bin_m - 0.5F;
        const bool inside = row > -0.5F && row < rows - 0.5F;
        const float faded =
            exp_neg(std::fma(equation.loss_per_m, range, -equation.ln_headroom), min_loss);
        const float lost = std::min(faded / (r * r * s * s), std::numeric_limits<float>::max());
        block.power[k] = inside ? std::min(block.power[k] * lost, max_echo) : 0.0F;
        block.row[k] = inside ? row : 0.0F;
        outside += inside ? 0 : 2;
    }
    use_reciprocal_path(block, block.images, block.points, use);
    use_reciprocal_path(block, block.points, block.images, use);
    block.count = 0;
    return outside;
}

/// The number of pieces of an edge, so that each is a point both at its place and at its image.
int pieces_of_both(const SpecularPath& piece, const Eigen::Vector3f SpecularPath::Place::*edge,
                   const PointLimits& limits) {
    int patches = 1;
    for (const SpecularPath::Place* place : {&piece.point, &piece.image_source}) {
        const Arrival arrival = arrival_of(place->at);
        patches = std::max(patches, patches_along(extents_of(place->*edge, arrival.direction),
                                                  arrival.range_m, limits));
    }
    return patches;
}

}  // namespace

std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene,
                                         std::span<const Backscatter> materials, ViewShape shape) {
    const std::optional<WaterMirror> water = mirror_of(scene.water_surface, traced.T_world_sensor);
    const PieceStrengths strengths(traced, scene, shape);
    std::vector<SpecularPath> paths;
    paths.reserve(traced.bounces.size());
    for (const BouncePath& path : traced.bounces) {
        if (path.material == no_material) continue;
        const Sample& sample = traced.starts().items[path.sample];
        paths.push_back(specular_path(path, sample, path.by_water_surface ? &*water : nullptr));
        paths.back().sample = path.sample;
        paths.back().reflection = scene.materials[sample.material].reflection *
                                  materials[sample.material].mirrored * sample.strength *
                                  strengths.at(sample) * path.water_reflection * path.strength;
    }
    return paths;
}

std::uint64_t find_specular_echoes(std::span<const SpecularPath> paths,
                                   std::span<const Backscatter> materials,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   const UseBlock& use) {
    PiecesOfPaths block;
    std::uint64_t outside = 0;
    for (std::uint32_t number = 0; number < paths.size(); ++number) {
        const SpecularPath& path = paths[number];
        const int rows = pieces_of_both(path, &SpecularPath::Place::u, limits);
        const int columns = pieces_of_both(path, &SpecularPath::Place::v, limits);
        const float power = materials[path.material].between(path.sine_of_point, path.sine_of_image,
                                                             path.sine_between) *
                            path.reflection * path.area_m2 / static_cast<float>(rows * columns);
        for_each_middle(rows, columns, [&](float s, float t) {
            put_place(block.points, block.count, path.point, s, t);
            put_place(block.images, block.count, path.image_source, s, t);
            block.path[block.count] = number;
            block.power[block.count] = power;
            if (++block.count == PatchBlock::capacity) outside += use_block(equation, block, use);
        });
    }
    return outside + use_block(equation, block, use);
}

}  // namespace sonarsim
