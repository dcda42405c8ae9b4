#include <doctest/doctest.h>
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "hard/tools.h"
#include "sonar/engine_settings.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "validation/image_error.h"
#include "validation/reference.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

namespace {

/// The exponent b of y = a x^b, from least squares of log y on log x.
double fit_exponent(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i] / x[0]);
        const double v = std::log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// The convergence of an engine's error with its resolution.
struct ConvergenceOrder {
    std::string scene;  ///< smooth, edgy or grazing
    std::string engine;
    std::string step;  ///< refined quantity: the error goal of the rays
    std::vector<double> steps;
    std::vector<double> errors;  ///< relative L1 against the reference, one per step
    double order = 0.0;          ///< p of error ~ step^p, by least squares
};

struct Subject {
    const char* name;
    Scene scene;
    Pose T_world_sensor;
};

std::vector<Subject> subjects() {
    const auto down = [](double pitch_deg, const Eigen::Vector3d& at) {
        return Pose{rotation_from_rpy(0.0, radians(pitch_deg), 0.1), at};
    };
    return {{"smooth", test::rough_floor(), down(35.0, {0.3, 0.2, 4.0})},
            {"edgy", test::tank(), down(15.0, {-2.4, 0.4, 1.5})},
            {"grazing", test::rough_floor(), down(5.0, {0.3, 0.2, 1.3})}};
}

double error_of(const Subject& subject, const Sonar& sonar, const VisibilityEngine& engine,
                const Reference& truth) {
    const Ping ping = render_ping(sonar, subject.scene, engine, subject.T_world_sensor, {1, 0});
    return image_error(ping.intensity, truth.intensity).relative_l1;
}

/// Measured on images of an imaging sonar. Ray spacing along a beam is proportional to the error
/// goal, and the permitted range uncertainty between two rays to its power of 3/2; ray spacing
/// across a beam is the same for all goals.
std::vector<ConvergenceOrder> convergence_orders() {
    std::vector<ConvergenceOrder> all;
    Sonar sonar = without_gain(hard_sonar(SonarKind::imaging));
    for (const Subject& subject : subjects()) {
        const Caster caster(subject.scene);
        const Reference truth = cast_reference(caster, subject.scene, sonar.settings.view,
                                               subject.T_world_sensor, {0.001, 256.0, 16'000'000});
        ConvergenceOrder rays{
            subject.name, "rays", "relative_l1", {0.24, 0.12, 0.06, 0.03, 0.015}, {}};
        const std::unique_ptr<VisibilityEngine> engine =
            make_engine(subject.scene, {EngineKind::rays, {}});
        for (const double goal : rays.steps) {
            Sonar finer = sonar;
            finer.settings.view.relative_l1 = goal;
            rays.errors.push_back(error_of(subject, finer, *engine, truth));
        }
        rays.order = fit_exponent(rays.steps, rays.errors);
        all.push_back(std::move(rays));
    }
    return all;
}

std::string orders_table(const std::vector<ConvergenceOrder>& orders) {
    std::string text =
        fmt::format("{:<10}{:<8}{:<13}{:>6}  {}\n", "scene", "engine", "step", "order", "errors");
    for (const ConvergenceOrder& one : orders) {
        text +=
            fmt::format("{:<10}{:<8}{:<13}{:>6.2f} ", one.scene, one.engine, one.step, one.order);
        for (std::size_t i = 0; i < one.steps.size(); ++i)
            text += fmt::format(" {:g}: {:.4f}", one.steps[i], one.errors[i]);
        text += "\n";
    }
    return text;
}

}  // namespace

TEST_CASE("the error of rays falls with their goal" *
          doctest::skip(test::sanitized)) {
    const std::vector<ConvergenceOrder> orders = convergence_orders();
    REQUIRE(orders.size() == 3);
    MESSAGE(orders_table(orders));
    for (const ConvergenceOrder& one : orders) {
        CAPTURE(one.scene);
        CAPTURE(one.engine);
        CAPTURE(one.order);
        // Silhouettes and bin edges limit the order to one; less than half of that would not be
        // convergence.
        CHECK(one.order > 0.4);
        CHECK(one.errors.back() < 0.5 * one.errors.front());
        // The steps of the rays are their error goals; a single pose may miss its goal.
        for (std::size_t i = 0; i < one.steps.size(); ++i)
            CHECK(one.errors[i] < 1.2 * one.steps[i]);
    }
}

TEST_SUITE_END();
