#include "calibrated/flat_plate.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "core/units.h"
#include "support/sanitized.h"

using namespace sonarsim;

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr EdgeLimits fine{.depth_m = 0.01, .sine = 0.01};

/// The edges of a polygon by its corners in a plane: `centre` + u x + v y.
std::vector<PlateEdge> edges_of(const Points& corners) {
    std::vector<PlateEdge> out;
    for (std::size_t k = 0; k < corners.size(); ++k)
        out.push_back({corners[k], corners[(k + 1) % corners.size()]});
    return out;
}

std::complex<double> echo_of(const std::vector<PlateEdge>& edges, const Eigen::Vector3d& normal,
                             double wavelength_m, double reflection = 1.0,
                             double roughness_m = 0.0) {
    PlateOfPing plate;
    plate.edges = edges;
    plate.normal = normal;
    plate.height_m = normal.dot(edges.front().from);
    std::vector<PlateEcho> echoes;
    add_plate_echoes(plate, {reflection, roughness_m}, wavelength_m, fine, echoes);
    std::complex<double> sum = 0.0;
    for (const PlateEcho& echo : echoes)
        sum += echo.amplitude;
    return sum;
}

double db_of(std::complex<double> amplitude) {
    return 20.0 * std::log10(std::abs(amplitude));
}

/// A rectangle of 2 a by 2 b at a range on the x axis, turned about the z axis.
struct Rectangle {
    std::vector<PlateEdge> edges;
    Eigen::Vector3d normal;

    Rectangle(double range_m, double a_m, double b_m, double turned_rad = 0.0) {
        const Eigen::Vector3d u{-std::sin(turned_rad), std::cos(turned_rad), 0.0};
        const Eigen::Vector3d v{0.0, 0.0, 1.0};
        const Eigen::Vector3d centre{range_m, 0.0, 0.0};
        edges = edges_of({centre - a_m * u - b_m * v, centre + a_m * u - b_m * v,
                          centre + a_m * u + b_m * v, centre - a_m * u + b_m * v});
        normal = {std::cos(turned_rad), std::sin(turned_rad), 0.0};
    }
};

/// The rectangle along a line that reaches `half_m` across it to either side.
PlateOfPing plate_along(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& across, double half_m) {
    const std::array<Eigen::Vector3d, 4> corners{from - half_m * across, to - half_m * across,
                                                 to + half_m * across, from + half_m * across};
    PlateOfPing out;
    for (std::size_t k = 0; k < 4; ++k)
        out.edges.push_back({corners[k], corners[(k + 1) % 4]});
    out.normal = across.cross(to - from).normalized();
    if (out.normal.dot(from) < 0.0) out.normal = -out.normal;
    out.height_m = out.normal.dot(from);
    return out;
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("flat plate: far away it has 20 log(A / lambda), and its lobes") {
        // Beyond L^2 / lambda the phase over the plate is even: p = A / (lambda r^2) at normal
        // incidence. Turned by t, the phase runs along one side L, so p has the further factor
        // cos t sin(b) / b, b = k L sin t.
        constexpr double wavelength = 1.5e-3;
        constexpr double side = 0.1;
        constexpr double range = 100.0;  // L^2 / lambda is 6.7 m
        const double k = 2.0 * pi / wavelength;
        for (const double turned_deg : {0.0, 0.1, 0.3, 0.55, 0.8, 1.1, 2.8, 9.1, 23.3, 60.0}) {
            const double t = radians(turned_deg);
            const double b = k * side * std::sin(t);
            const double lobes = b == 0.0 ? 1.0 : std::sin(b) / b;
            const Rectangle plate(range, 0.5 * side, 0.5 * side, t);
            const double expected = 20.0 * std::log10(side * side / (wavelength * range * range) *
                                                      std::cos(t) * std::fabs(lobes));
            if (std::fabs(std::sin(b)) < 0.3 && b > 0.0) continue;  // near a null
            CAPTURE(turned_deg);
            CHECK(std::fabs(db_of(echo_of(plate.edges, plate.normal, wavelength)) - expected) <
                  0.5);
        }
    }

    TEST_CASE("flat plate: close by it is the image source, V / (2 H)") {
        for (const double reflection : {1.0, 0.25}) {
            const Rectangle wall(3.0, 20.0, 17.0);
            const double expected = 20.0 * std::log10(std::sqrt(reflection) / (2.0 * 3.0));
            const double found = db_of(echo_of(wall.edges, wall.normal, 1.5e-3, reflection));
            CHECK(std::fabs(found - expected) < 0.1);
        }
    }

    TEST_CASE("flat plate: a disc on the axis grows and fades by Fresnel zones") {
        // All of the rim is at the range s: p = |exp(2 i k s) H / (2 s^2) - exp(2 i k H) / (2 H)|.
        constexpr double wavelength = 5e-3;
        constexpr double height = 4.0;
        const double k = 2.0 * pi / wavelength;
        for (const double radius : {0.02, 0.05, 0.08, 0.1, 0.12, 0.16, 0.3}) {
            Points rim;
            constexpr int corners = 720;
            for (int c = 0; c < corners; ++c) {
                const double angle = 2.0 * pi * c / corners;
                rim.push_back({height, radius * std::cos(angle), radius * std::sin(angle)});
            }
            const double s = std::hypot(height, radius);
            const double expected = std::abs(std::polar(height / (2.0 * s * s), 2.0 * k * s) -
                                             std::polar(1.0 / (2.0 * height), 2.0 * k * height));
            const std::complex<double> found =
                echo_of(edges_of(rim), Eigen::Vector3d::UnitX(), wavelength);
            CAPTURE(radius);
            // The greatest echo is twice the image source: this is 1 % of it.
            CHECK(std::fabs(std::abs(found) - expected) * height < 0.01);
        }
    }

    TEST_CASE("flat plate: triangles at random, against the Kirchhoff integral by points") {
        std::mt19937 random(7);
        const auto number = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
        };
        constexpr double wavelength = 0.02;
        const double k = 2.0 * pi / wavelength;
        for (int trial = 0; trial < (test::sanitized ? 1 : 12); ++trial) {
            const double height = number(0.8, 3.0);
            Points corners;
            for (int c = 0; c < 3; ++c)
                corners.push_back({number(-0.5, 0.5), number(-0.5, 0.5), height});
            const Eigen::Vector3d u = corners[1] - corners[0];
            const Eigen::Vector3d v = corners[2] - corners[0];
            // Middles of parts that are alike, a twentieth of a wavelength or less across.
            constexpr int parts = 1200;
            const double area = 0.5 * u.cross(v).norm() / (parts * parts);
            std::complex<double> sum = 0.0;
            for (int i = 0; i < parts; ++i) {
                for (int j = 0; i + j < parts; ++j) {
                    for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
                        if (third > 0.5 && i + j + 1 == parts) continue;
                        const double r =
                            (corners[0] + (i + third) / parts * u + (j + third) / parts * v).norm();
                        sum += std::polar(area * height / (r * r * r), 2.0 * k * r);
                    }
                }
            }
            sum *= std::complex<double>(0.0, 1.0) / wavelength;
            const std::complex<double> found =
                echo_of(edges_of(corners), Eigen::Vector3d::UnitZ(), wavelength);
            CAPTURE(trial);
            // Half a decibel of the sum, or 1 % of the image source where the sum is about 0: the
            // next term of the integral over r is 1 / (kr) of the first.
            CHECK(std::abs(found - sum) < 0.059 * std::abs(sum) + 0.01 / (2.0 * height));
        }
    }

    TEST_CASE("flat plate: two parts have the echo of the whole") {
        std::mt19937 random(8);
        const auto number = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
        };
        for (int trial = 0; trial < 20; ++trial) {
            const Eigen::Vector3d normal =
                Eigen::Vector3d(1.0, number(-0.5, 0.5), number(-0.5, 0.5)).normalized();
            const Eigen::Vector3d u = normal.unitOrthogonal();
            const Eigen::Vector3d v = normal.cross(u);
            const auto at = [&](double x, double y) -> Eigen::Vector3d {
                return 4.0 * Eigen::Vector3d::UnitX() + x * u + y * v;
            };
            const Points whole{at(-1.0, -1.0), at(number(-0.5, 0.5), -1.0), at(1.0, -1.0),
                               at(1.0, 1.0),   at(number(-0.5, 0.5), 1.0),  at(-1.0, 1.0)};
            const Points left{whole[0], whole[1], whole[4], whole[5]};
            const Points right{whole[1], whole[2], whole[3], whole[4]};
            const std::complex<double> sum =
                echo_of(edges_of(left), normal, 3e-3) + echo_of(edges_of(right), normal, 3e-3);
            const std::complex<double> of_whole = echo_of(edges_of(whole), normal, 3e-3);
            // Within 0.3 % of the image source.
            CHECK(std::abs(sum - of_whole) < 0.003 / (2.0 * 4.0));
        }
    }

    TEST_CASE("flat plate: parts that meet at the foot have the echo of the whole") {
        std::mt19937 random(9);
        const auto number = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
        };
        for (int trial = 0; trial < 500; ++trial) {
            const double wavelength = number(2e-3, 15e-3);
            const Eigen::Vector3d foot = number(10.0, 30.0) * Eigen::Vector3d::UnitX();
            const double roll = number(0.0, 7.0);
            const Eigen::Vector3d u(0.0, std::cos(roll), std::sin(roll));
            const Eigen::Vector3d v = foot.normalized().cross(u);
            const double half_u = number(0.01, 0.07);
            const double half_v = number(0.01, 0.07);
            const auto echo = [&](double from, double to) {
                std::vector<PlateEcho> echoes;
                add_plate_echoes(plate_along(foot + from * u, foot + to * u, v, half_v), {},
                                 wavelength, {}, echoes);
                std::complex<double> sum = 0.0;
                for (const PlateEcho& part : echoes)
                    sum += part.amplitude;
                return sum;
            };
            const std::complex<double> whole = echo(-half_u, half_u);
            const std::complex<double> parts = echo(-half_u, 0.0) + echo(0.0, half_u);
            CAPTURE(trial);
            CHECK(std::abs(parts - whole) < 0.02 * std::abs(whole));
        }
    }

    TEST_CASE("flat plate: roughness takes exp(-(2 k h sin)^2) of the power") {
        constexpr double wavelength = 1.5e-3;
        const Rectangle wall(3.0, 5.0, 5.0);
        const std::complex<double> smooth = echo_of(wall.edges, wall.normal, wavelength);
        for (const double roughness : {2e-5, 1e-4, 2e-4}) {
            const double phase = 2.0 * 2.0 * pi / wavelength * roughness;
            const std::complex<double> rough =
                echo_of(wall.edges, wall.normal, wavelength, 1.0, roughness);
            CHECK(std::fabs(db_of(rough / smooth) +
                            10.0 * std::log10(std::exp(1.0)) * phase * phase) < 0.1);
        }
    }
}
