#include "core/random.h"
#include "input/scene/placing/scatter.h"
#include "support/test.h"

namespace {

/// A bottom of 40 x 40 cells of half a metre about the origin. height() computes its height
/// independently: the diagonal of a cell runs from its corner of least x and y to that of largest.
struct Waves {
    static constexpr int cells = 40;
    static constexpr double cell_m = 0.5;
    static constexpr double half_m = 0.5 * cells * cell_m;

    static double node(int i, int j) {
        return 0.4 * std::sin(0.9 * i) * std::cos(0.7 * j) + 0.05 * ((i * 7 + j * 13) % 5);
    }
    static Surface surface() {
        Surface out;
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i)
                out.vertices.emplace_back(i * cell_m - half_m, j * cell_m - half_m, node(i, j));
        }
        for (std::uint32_t j = 0; j < cells; ++j) {
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t a = j * (cells + 1) + i;
                out.triangles.push_back({a, a + 1, a + cells + 2});
                out.triangles.push_back({a, a + cells + 2, a + cells + 1});
            }
        }
        return out;
    }
    static double height(double x, double y) {
        const double u = (x + half_m) / cell_m;
        const double v = (y + half_m) / cell_m;
        const int i = std::clamp(static_cast<int>(u), 0, cells - 1);
        const int j = std::clamp(static_cast<int>(v), 0, cells - 1);
        const double s = u - i;
        const double t = v - j;
        const double diagonal = node(i + 1, j + 1);
        return s >= t ? node(i, j) + s * (node(i + 1, j) - node(i, j)) +
                            t * (diagonal - node(i + 1, j))
                      : node(i, j) + t * (node(i, j + 1) - node(i, j)) +
                            s * (diagonal - node(i, j + 1));
    }
};

Surface box(double x, double y, double z) {
    Surface out;
    for (int i = 0; i < 8; ++i)
        out.vertices.emplace_back((i & 1 ? x : -x), (i & 2 ? y : -y), (i & 4 ? z : -z));
    out.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                     {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return out;
}

/// The plane z = a x + b y, |x|, |y| <= half_m.
Surface plane(double half_m, double a, double b) {
    Surface out;
    for (const auto& [x, y] :
         {std::pair(-half_m, -half_m), {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}})
        out.vertices.emplace_back(x, y, a * x + b * y);
    out.triangles = {{0, 1, 2}, {0, 2, 3}};
    return out;
}

/// The least height above the bottom, of edges in millimetres and of faces over its nodes.
double min_gap(const Surface& object) {
    double gap = 1e9;
    const auto node_of = [](double x) { return (x + Waves::half_m) / Waves::cell_m; };
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        const std::array<Eigen::Vector3d, 3> corners = corners_of(object, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3d along = corners[(k + 1) % 3] - corners[k];
            const int steps = 1 + static_cast<int>(along.norm() / 1e-3);
            for (int n = 0; n <= steps; ++n) {
                const Eigen::Vector3d p = corners[k] + static_cast<double>(n) / steps * along;
                gap = std::min(gap, p.z() - Waves::height(p.x(), p.y()));
            }
        }
        // A place of the face by the shares of its corners.
        Eigen::Matrix3d from_shares;
        from_shares << corners[0], corners[1], corners[2];
        const Eigen::RowVector3d heights = from_shares.row(2);
        from_shares.row(2).setOnes();
        if (std::fabs(from_shares.determinant()) < 1e-9) continue;
        const Eigen::Matrix3d to_shares = from_shares.inverse();
        const Eigen::AlignedBox2d around = box_from_above(corners);
        for (int j = static_cast<int>(std::ceil(node_of(around.min().y())));
             j <= node_of(around.max().y()); ++j) {
            for (int i = static_cast<int>(std::ceil(node_of(around.min().x())));
                 i <= node_of(around.max().x()); ++i) {
                const Eigen::Vector3d shares =
                    to_shares * Eigen::Vector3d(i * Waves::cell_m - Waves::half_m,
                                                j * Waves::cell_m - Waves::half_m, 1.0);
                if (shares.minCoeff() >= 0.0)
                    gap = std::min(gap, heights.dot(shares) - Waves::node(i, j));
            }
        }
    }
    return gap;
}

/// True if two convex bodies meet as seen from above: no line through two corners of one of them
/// has all of it on one side and the other body on the other.
bool meet_from_above(const Surface& one, const Surface& other) {
    const auto is_apart = [](const Surface& from, const Surface& to) {
        for (const Eigen::Vector3d& p : from.vertices) {
            for (const Eigen::Vector3d& q : from.vertices) {
                const Eigen::Vector2d across(p.y() - q.y(), q.x() - p.x());
                const auto side = [&](const Eigen::Vector3d& v) {
                    return across.dot((v - p).head<2>());
                };
                if (std::ranges::all_of(from.vertices, [&](auto& v) { return side(v) < 1e-9; }) &&
                    std::ranges::all_of(to.vertices, [&](auto& v) { return side(v) > 1e-9; }))
                    return true;
            }
        }
        return false;
    };
    return !is_apart(one, other) && !is_apart(other, one);
}

/// Twenty objects that are drawn, in their places.
std::vector<Surface> put(const std::vector<Surface>& shapes, ScatterConfig rule, std::uint64_t seed,
                         const Bottom& bottom) {
    rule.name = "thing";
    std::vector<const Surface*> kinds;
    for (const Surface& shape : shapes)
        kinds.push_back(&shape);
    rule.count = {20, 20};
    rule.area_min_m = {-8, -8};
    rule.area_max_m = {8, 8};
    rule.roll_deg = {-29, 29};
    rule.pitch_deg = {-29, 29};
    rule.yaw_deg = {-172, 172};
    rule.scale = {0.6, 1.4};
    TakenGround taken;
    std::vector<Surface> out;
    for (const ScatteredObject& object : scatter(rule, kinds, 0, seed, bottom, taken))
        out.push_back(moved(shapes[object.shape], object.T_world_shape));
    return out;
}

}  // namespace

TEST_CASE("placing: a thousand objects rest on the bottom within a millimetre, and none meet" *
          doctest::skip(sanitized)) {
    const Bottom bottom(Waves::surface());
    const std::vector<Surface> shapes{box(0.3, 0.2, 0.1), box(0.5, 0.05, 0.05),
                                      box(0.15, 0.15, 0.4)};
    for (const bool align : {false, true}) {
        ScatterConfig rule;
        rule.align = align;
        double highest = -1e9;
        double lowest = 1e9;
        int meetings = 0;
        int outside = 0;
        for (std::uint64_t seed = 0; seed < 25; ++seed) {
            const auto placed = put(shapes, rule, seed, bottom);
            REQUIRE(placed.size() == 20);
            for (std::size_t i = 0; i < placed.size(); ++i) {
                const double gap = min_gap(placed[i]);
                highest = std::max(highest, gap);
                lowest = std::min(lowest, gap);
                for (std::size_t k = 0; k < placed.size(); ++k)
                    meetings += k != i && meet_from_above(placed[i], placed[k]);
                for (const Eigen::Vector3d& v : placed[i].vertices)
                    outside += v.head<2>().cwiseAbs().maxCoeff() > 8.0;
            }
        }
        CHECK(lowest > -1e-9);  // nothing is inside the bottom
        CHECK(highest < 1e-3);  // everything touches it
        CHECK(meetings == 0);
        CHECK(outside == 0);
    }
}

TEST_CASE("placing: metres or a share of the height are buried, what would vanish is redrawn") {
    const Bottom bottom(Waves::surface());
    const std::vector<Surface> shapes{box(0.3, 0.2, 0.1)};
    for (const auto& [metres, share] : {std::pair(0.07, 0.0), {0.0, 0.4}, {0.0, -0.5}}) {
        ScatterConfig rule;
        rule.bury_m = {metres, metres};
        rule.bury = {share, share};
        const auto once = put(shapes, rule, 5, bottom);
        const auto again = put(shapes, rule, 5, bottom);
        const auto other = put(shapes, rule, 6, bottom);
        for (std::size_t i = 0; i < once.size(); ++i) {
            const double buried_m = metres + share * box_of(once[i]).sizes().z();
            CHECK(std::fabs(min_gap(once[i]) + buried_m) < 1e-3);
            CHECK(once[i].vertices[0] == again[i].vertices[0]);
            CHECK(once[i].vertices[0] != other[i].vertices[0]);
        }
    }
    ScatterConfig rule;
    rule.bury_m = {0.0, 3.0};  // few of the draws leave a part in sight
    rule.overlap = true;
    for (const Surface& one : put(shapes, rule, 5, bottom))
        CHECK(!lies_below(bottom, one));
    rule.bury_m = {9.0, 9.0};
    CHECK_THROWS_AS(put(shapes, rule, 5, bottom), InputError);
}

TEST_CASE("placing: on a plane a box that is aligned lies flat on it") {
    // z = 0.3 x + 0.1 y: all four corners of the box's lower face must lie in the plane.
    const Bottom bottom(plane(9, 0.3, 0.1));
    const Surface shape = box(0.4, 0.2, 0.1);
    const auto T =
        put_on_bottom(bottom, shape, {2.0, -3.0},
                      {.rotation = rotation_from_rpy(0, 0, 0.7), .scale = 2.0, .align = true});
    REQUIRE(T);
    const Surface placed = moved(shape, *T);
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d& v = placed.vertices[k];
        CHECK(std::fabs(v.z() - 0.3 * v.x() - 0.1 * v.y()) < 1e-9);
    }
    CHECK(T->translation().head<2>() == Eigen::Vector2d(2.0, -3.0));
}

TEST_CASE("placing: room beside hulls of all sizes is that beside each hull one by one" *
          doctest::skip(sanitized)) {
    auto draw = [counter = std::uint32_t{0}](double low, double high) mutable {
        const PhiloxBlock block = philox({counter++, 0, 0, 0}, PhiloxKey{});
        return low + (high - low) * unit_double(block.x0, block.x1);
    };
    const auto hull = [&] {
        const double size = std::pow(10.0, draw(-3.0, 1.3));
        const double x = draw(-300.0, 300.0);
        const double y = draw(-30.0, 30.0);
        std::vector<Eigen::Vector3d> points;
        for (int k = 0; k < 6; ++k)
            points.emplace_back(x + size * draw(0, 1), y + size * draw(0, 1), 0.0);
        return hull_of(points);
    };
    TakenGround ground;
    std::vector<Hull> all;
    int free = 0;
    for (int i = 0; i < 3000; ++i) {
        const Hull room = hull();
        const double spacing = i % 3 == 0 ? 0.0 : std::pow(10.0, draw(-2.0, 1.0));
        const bool alone = std::ranges::none_of(all, [&](const Hull& other) {
            const double distance = distance_between(room, other);
            return distance <= 0.0 || distance < spacing;
        });
        CHECK(ground.has_room(room, spacing) == alone);
        if (!alone) continue;
        ++free;
        ground.add(room);
        all.push_back(room);
    }
    CHECK(free > 300);
    CHECK(free < 2700);
}

TEST_CASE("placing: a density gives its mean number, below one object, too") {
    const Bottom bottom(plane(20, 0.0, 0.0));
    const Surface shape = box(0.3, 0.2, 0.1);
    const Surface* const shapes[] = {&shape};
    ScatterConfig rule;
    rule.density_per_m2 = {0.0005, 0.0015};
    rule.area_min_m = {-10, -10};
    rule.area_max_m = {10, 10};
    double count = 0.0;  // 0 or 1 each; 4.5 standard deviations are 98
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        TakenGround taken;
        count += static_cast<double>(scatter(rule, shapes, 0, seed, bottom, taken).size());
    }
    CHECK(std::fabs(count - 800.0) < 98.0);
}

TEST_CASE("placing: distances between hulls") {
    const Hull square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto shifted = [&](double x, double y) {
        Hull out = square;
        for (auto& p : out)
            p += Eigen::Vector2d(x, y);
        return out;
    };
    CHECK(distance_between(square, shifted(3.0, 0.5)) == 2.0);
    CHECK(std::fabs(distance_between(square, shifted(4.0, 5.0)) - 5.0) < 1e-12);
    CHECK(distance_between(square, shifted(0.5, 0.5)) == 0.0);
    CHECK(distance_between(square, {{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}}) == 0.0);
}

TEST_CASE("bottom: the next surface below a point is that of all triangles one by one" *
          doctest::skip(sanitized)) {
    // Three layers of waves at UTM coordinates, and points above, between, below and outside.
    Surface layers;
    const Surface one = Waves::surface();
    const Eigen::Vector3d place(5e5, 6e6, -40.0);
    for (int k = 0; k < 3; ++k) {
        const auto first = static_cast<std::uint32_t>(layers.vertices.size());
        for (const Eigen::Vector3d& vertex : one.vertices)
            layers.vertices.push_back(vertex + place + Eigen::Vector3d(0.3 * k, 0.1, 1.5 * k));
        for (const auto& [a, b, c] : one.triangles)
            layers.triangles.push_back({first + a, first + b, first + c});
    }
    const Bottom bottom(layers);
    const Eigen::AlignedBox3d around = box_of(layers);
    int found = 0;
    for (int n = 0; n < 500; ++n) {
        const Eigen::Array3d share(std::fmod(0.6180 * n, 1.0), std::fmod(0.7549 * n, 1.0),
                                   std::fmod(0.5698 * n, 1.0));
        const Eigen::Vector3d point =
            around.min() + ((1.2 * share - 0.1) * around.sizes().array()).matrix();
        const double tolerance = n % 2 == 0 ? 0.0 : 0.2;
        std::optional<double> highest;
        for (const auto& [a, b, c] : layers.triangles) {
            const auto z = height_above(
                {layers.vertices[a], layers.vertices[b], layers.vertices[c]}, point.head<2>());
            if (z && *z <= point.z() + tolerance && (!highest || *z > *highest)) highest = z;
        }
        CHECK(bottom.highest_below(point, tolerance) == highest);
        found += highest.has_value();
    }
    CHECK(found > 100);
    CHECK(found < 450);
}

TEST_CASE("bottom: thousands of triangles, each over all of it") {
    // In a grid of 438 x 438 cells they would lie in more than 2^32 cells together.
    constexpr int layers = 24000;
    Surface stack;
    for (std::uint32_t k = 0; k < layers; ++k) {
        const double z = -1.0 * k;
        for (const auto& [x, y] : {std::pair{-9.0, -9.0}, {27.0, -9.0}, {-9.0, 27.0}})
            stack.vertices.emplace_back(x, y, z);
        stack.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    const Bottom bottom(stack);
    CHECK(bottom.highest_below({0.0, 0.0, -4000.5}, 0.0) == -4001.0);
    CHECK(bottom.highest({1.0, 2.0}) == 0.0);
    CHECK(!bottom.highest({20.0, 20.0}));
}
