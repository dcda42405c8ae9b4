#include "assembly/engine_probes.h"
#include "benchmark/report.h"
#include "dataset/annotated_objects.h"
#include "labels/labels.h"

namespace sonarsim {

namespace {

struct LabelKind {
    const char* name;
    LabelRequest request;
};

/// The kinds by the names that output.labels has for them.
std::vector<LabelKind> label_kinds(const Bottom* bottom) {
    std::vector<LabelKind> kinds{{"instance", {.objects = true}},
                                 {"class", {.classes = true}},
                                 {"material", {.materials = true}},
                                 {"share", {.objects = true, .shares = true}},
                                 {"elevation", {.elevation = true}},
                                 {"shadow", {.shadow = true}},
                                 {"objects", {.objects = true, .annotations = true}},
                                 {"all",
                                  {.objects = true,
                                   .shares = true,
                                   .classes = true,
                                   .materials = true,
                                   .elevation = true,
                                   .shadow = true,
                                   .height = bottom != nullptr,
                                   .annotations = true,
                                   .bottom = bottom}}};
    if (bottom != nullptr) kinds.push_back({"height", {.height = true, .bottom = bottom}});
    return kinds;
}

/// Adds the CPU times of each kind at one pose; the kinds take turns. Returns the time of a ping.
double visit(const PingSet& pings, const Assembly& assembly, const Sonar& sonar,
             const VisibilityEngine& engine, const AnnotatedObjects& annotated, std::size_t p,
             std::span<const LabelKind> kinds, std::vector<std::vector<double>>& labels_ms) {
    PoseTimes times;
    const TracedPing traced = visit_pose(pings, sonar, engine, p, times);
    const SonarAtPose then = pings.at_pose(sonar, p);
    const double t_s = assembly.trajectory[pings.indices[p]].t_s;
    const std::vector<ObjectSphere> spheres = spheres_at(annotated, assembly, t_s);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        LabelRequest request = kinds[i].request;
        if (request.annotations) request.annotated = spheres;
        request.surface = &annotated.surface;
        const double start = thread_seconds_now();
        label_ping(traced, then->settings, pings.scene, assembly.objects, engine, request);
        labels_ms[i].push_back(1e3 * (thread_seconds_now() - start));
    }
    return median_of(times.ping_thread_ms);
}

}  // namespace

std::vector<LabelRow> measure_labels(const Mission& mission, const Assembly& assembly,
                                     const ReportOptions& options, const ReportProgress& progress) {
    if (mission.output.labels.empty()) return {};
    const PingSet pings(mission, assembly, options.poses);
    const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
    const AnnotatedObjects annotated = annotated_objects(assembly);
    const std::vector<LabelKind> kinds = label_kinds(assembly.bottom.get());
    std::vector<LabelRow> rows;
    for (const Sonar& sonar : assembly.sonars) {
        progress(sonar.config.name + ": labels");
        std::vector<std::vector<double>> medians(kinds.size());  // one per pose
        std::vector<std::vector<double>> ratios(kinds.size());
        for (std::size_t p = 0; p < pings.poses.size(); ++p) {
            std::vector<std::vector<double>> labels_ms(kinds.size());
            std::vector<double> ping_ms;
            for (int round = 0; round < options.rounds; ++round)
                ping_ms.push_back(
                    visit(pings, assembly, sonar, *engine, annotated, p, kinds, labels_ms));
            const double ping = median_of(ping_ms);
            for (std::size_t i = 0; i < kinds.size(); ++i) {
                medians[i].push_back(median_of(labels_ms[i]));
                ratios[i].push_back((ping + medians[i].back()) / ping);
            }
        }
        for (std::size_t i = 0; i < kinds.size(); ++i)
            rows.push_back({sonar.config.name, kinds[i].name, median_of(medians[i]),
                            median_of(ratios[i])});
    }
    return rows;
}

}  // namespace sonarsim
