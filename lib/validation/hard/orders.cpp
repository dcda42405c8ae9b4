#include "validation/hard/orders.h"

#include <spdlog/fmt/fmt.h>

#include <memory>
#include <utility>

#include "core/units.h"
#include "sonar/engine_settings.h"
#include "validation/fit.h"
#include "validation/hard/tools.h"
#include "validation/image_error.h"
#include "validation/reference.h"
#include "validation/shapes.h"

namespace sonarsim {

namespace {

struct Subject {
    const char* name;
    Scene scene;
    Pose T_world_sensor;
};

std::vector<Subject> subjects() {
    const auto down = [](double pitch_deg, const Eigen::Vector3d& at) {
        return Pose{rotation_from_rpy(0.0, radians(pitch_deg), 0.1), at};
    };
    return {{"smooth", shapes::rough_floor(), down(35.0, {0.3, 0.2, 4.0})},
            {"edgy", shapes::tank(), down(15.0, {-2.4, 0.4, 1.5})},
            {"grazing", shapes::rough_floor(), down(5.0, {0.3, 0.2, 1.3})}};
}

double error_of(const Subject& subject, const Sonar& sonar, const VisibilityEngine& engine,
                const Reference& truth) {
    const Ping ping = render_ping(sonar, subject.scene, engine, subject.T_world_sensor, {1, 0});
    return image_error(ping.intensity, truth.intensity).relative_l1;
}

}  // namespace

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
        ConvergenceOrder octree{subject.name, "octree", "leaf_m", {0.16, 0.08, 0.04, 0.02}, {}};
        for (const double leaf : octree.steps) {
            OctreeConfig config;
            config.leaf_m = leaf;
            octree.errors.push_back(error_of(
                subject, sonar,
                *make_engine(subject.scene, engine_settings(EngineKind::octree, config)), truth));
        }
        for (ConvergenceOrder* one : {&rays, &octree}) {
            one->order = fit_exponent(one->steps, one->errors);
            all.push_back(std::move(*one));
        }
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

}  // namespace sonarsim
