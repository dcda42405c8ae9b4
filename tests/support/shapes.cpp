#include "support/shapes.h"

#include "core/elementary.h"
#include "support/test.h"

namespace sonarsim::test {

namespace {

Eigen::Vector3f polar(float radius, double azimuth, double elevation) {
    return radius * direction_of(azimuth, elevation).cast<float>();
}

}  // namespace

Scene empty_scene(const Eigen::Vector3d& origin) {
    Scene scene;
    scene.origin = origin;
    scene.bounds_min = scene.bounds_max = origin;
    return scene;
}

void add_triangle(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                  const Eigen::Vector3f& c, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {a, b, c});
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangle_material.push_back(material);
    scene.triangle_instance.push_back(static_cast<std::uint32_t>(scene.instances.size() - 1));
}

std::uint32_t add_material(Scene& scene, float reflection) {
    scene.materials.push_back({std::to_string(reflection), 1.0, 1.0, reflection});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void add_quad(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
              const Eigen::Vector3f& c, const Eigen::Vector3f& d, std::uint32_t material, int n) {
    scene.instances.push_back("quad" + std::to_string(scene.instances.size()));
    const auto at = [&](int i, int j) -> Eigen::Vector3f {
        const float u = static_cast<float>(i) / static_cast<float>(n);
        const float v = static_cast<float>(j) / static_cast<float>(n);
        return (1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * c);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            add_triangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1), material);
            add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1), material);
        }
    }
}

void add_rectangle(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& c,
                   std::uint32_t material, int n) {
    // The axes of its sides.
    const int u = a.x() == c.x() ? 1 : 0;
    const int v = a.z() == c.z() ? 1 : 2;
    Eigen::Vector3f b = a;
    b[u] = c[u];
    Eigen::Vector3f d = a;
    d[v] = c[v];
    add_quad(scene, a, b, c, d, material, n);
}

void add_floor(Scene& scene, float half_size, float z, std::uint32_t material, int n) {
    add_rectangle(scene, {-half_size, -half_size, z}, {half_size, half_size, z}, material, n);
}

Scene rectangle_scene(const Eigen::Vector3f& a, const Eigen::Vector3f& c, float reflection, int n) {
    Scene scene = empty_scene();
    add_rectangle(scene, a, c, add_material(scene, reflection), n);
    return scene;
}

Scene floor_scene(float half_size, float z, float reflection, int n) {
    Scene scene = empty_scene();
    add_floor(scene, half_size, z, add_material(scene, reflection), n);
    return scene;
}

void add_box(Scene& scene, const Eigen::Vector3f& min, const Eigen::Vector3f& max,
             std::uint32_t material) {
    const std::array sides{min, max};
    for (int axis = 0; axis < 3; ++axis) {
        for (const Eigen::Vector3f& side : sides) {
            Eigen::Vector3f a = min;
            Eigen::Vector3f c = max;
            a[axis] = c[axis] = side[axis];
            add_rectangle(scene, a, c, material);
            if ((&side != sides.data()) == (axis != 1)) continue;
            for (auto triangle = scene.triangles.end() - 2; triangle != scene.triangles.end();
                 ++triangle)
                std::swap((*triangle)[1], (*triangle)[2]);
        }
    }
}

void add_sphere(Scene& scene, const Eigen::Vector3f& centre, float radius, std::uint32_t material,
                int n) {
    scene.instances.push_back("sphere" + std::to_string(scene.instances.size()));
    const int parallels = n / 2;
    const auto at = [&](int i, int j) -> Eigen::Vector3f {
        return centre + polar(radius, 2.0 * pi * i / n, -0.5 * pi + pi * j / parallels);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < parallels; ++j) {
            if (j > 0) add_triangle(scene, at(i, j), at(i + 1, j), at(i + 1, j + 1), material);
            if (j + 1 < parallels)
                add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i, j + 1), material);
        }
    }
}

void add_pole(Scene& scene, const Eigen::Vector3f& foot, float radius, float height,
              std::uint32_t material, int n) {
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector3f a = foot + polar(radius, 2.0 * pi * i / n, 0.0);
        const Eigen::Vector3f b = foot + polar(radius, 2.0 * pi * (i + 1) / n, 0.0);
        const Eigen::Vector3f up = height * Eigen::Vector3f::UnitZ();
        add_quad(scene, a, b, b + up, a + up, material);
    }
}

void add_bar(Scene& scene, const Eigen::Vector3f& a, const Eigen::Vector3f& b, float radius,
             int sides, bool closed, std::uint32_t material) {
    const Eigen::Vector3f along = b - a;
    const Eigen::Vector3f u = along.unitOrthogonal() * radius;
    const Eigen::Vector3f v = along.normalized().cross(u);
    const auto rim = [&](const Eigen::Vector3f& centre, int k) -> Eigen::Vector3f {
        const SinCos at = sincos(2.0 * pi * (k % sides) / sides);
        return centre + static_cast<float>(at.cos) * u + static_cast<float>(at.sin) * v;
    };
    for (int k = 0; k < sides; ++k) {
        add_triangle(scene, rim(a, k), rim(a, k + 1), rim(b, k + 1), material);
        add_triangle(scene, rim(a, k), rim(b, k + 1), rim(b, k), material);
        if (!closed) continue;
        add_triangle(scene, a, rim(a, k + 1), rim(a, k), material);
        add_triangle(scene, b, rim(b, k), rim(b, k + 1), material);
    }
}

Scene sphere_scene(const Eigen::Vector3f& centre, float radius, float reflection, int n) {
    Scene scene = empty_scene();
    add_sphere(scene, centre, radius, add_material(scene, reflection), n);
    return scene;
}

Scene box_scene(const Eigen::Vector3f& min, const Eigen::Vector3f& max, float reflection) {
    Scene scene = empty_scene();
    add_box(scene, min, max, add_material(scene, reflection));
    return scene;
}

Scene tank() {
    Scene scene = empty_scene();
    const std::uint32_t concrete = add_material(scene, 0.5F);
    const std::uint32_t steel = add_material(scene, 0.88F);
    const std::uint32_t wood = add_material(scene, 0.15F);
    add_rectangle(scene, {-4, -3, 0}, {4, 3, 0}, concrete);
    add_rectangle(scene, {-4, -3, 0}, {4, -3, 3}, concrete);
    add_rectangle(scene, {-4, 3, 0}, {4, 3, 3}, concrete);
    add_rectangle(scene, {-4, -3, 0}, {-4, 3, 3}, concrete);
    add_rectangle(scene, {4, -3, 0}, {4, 3, 3}, concrete);
    add_pole(scene, {1.0F, 0.7F, 0.0F}, 0.06F, 3.0F, steel);
    add_box(scene, {1.5F, -1.5F, 0.0F}, {2.0F, -1.0F, 0.5F}, steel);
    add_box(scene, {2.5F, 0.2F, 0.0F}, {3.1F, 0.9F, 0.7F}, wood);
    add_sphere(scene, {2.0F, -0.2F, 1.2F}, 0.15F, steel, 64);
    return scene;
}

Scene rough_floor() {
    Scene scene = empty_scene();
    const std::uint32_t materials[] = {add_material(scene, 0.2F), add_material(scene, 0.4F)};
    constexpr int n = 300;  // cells of 20 cm
    const auto point = [](int i, int j) -> Eigen::Vector3f {
        const double x = 0.2 * i - 30.0;
        const double y = 0.2 * j - 30.0;
        const double z = 0.3 * sincos(0.5 * x).sin + 0.2 * sincos(0.7 * y + 0.3 * x).cos +
                         0.04 * sincos(4.0 * x + y).sin + 0.02 * sincos(9.0 * y - 2.0 * x).sin;
        return Eigen::Vector3d(x, y, z).cast<float>();
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            add_quad(scene, point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1),
                     materials[(i / 40 + j / 40) % 2]);
        }
    }
    return scene;
}

}  // namespace sonarsim::test
