#include "benchmark/label_rows.h"

#include <utility>

#include "assembly/engine_probes.h"
#include "benchmark/thread_clock.h"
#include "benchmark/timed_pings.h"
#include "dataset/annotated_objects.h"
#include "labels/labels.h"

namespace sonarsim {

namespace {

struct LabelKind {
    const char* name;
    LabelRequest request;
};

/// The kinds by the names that output.labels has for them. Labels that need the same computation
/// share a row.
std::vector<LabelKind> label_kinds(const Bottom* bottom) {
    std::vector<LabelKind> kinds{{"instance", {.objects = true}},
                                 {"class", {.classes = true}},
                                 {"material", {.materials = true}},
                                 {"all ids", {.objects = true, .classes = true, .materials = true}},
                                 {"share", {.objects = true, .shares = true}},
                                 {"elevation", {.elevation = true}},
                                 {"shadow", {.shadow = true}},
                                 {"objects", {.objects = true, .annotations = true}}};
    if (bottom != nullptr) kinds.push_back({"height", {.height = true, .bottom = bottom}});
    kinds.push_back({"all",
                     {.objects = true,
                      .shares = true,
                      .classes = true,
                      .materials = true,
                      .elevation = true,
                      .shadow = true,
                      .height = bottom != nullptr,
                      .annotations = true,
                      .bottom = bottom}});
    return kinds;
}

/// CPU times at one pose, over all rounds.
struct LabelTimes {
    std::vector<double> ping_ms;
    std::vector<std::vector<double>> labels_ms;  ///< one list per kind
};

void visit(const PingSet& pings, const Assembly& assembly, const Sonar& sonar,
           const VisibilityEngine& engine, const AnnotatedObjects& annotated, std::size_t p,
           std::span<const LabelKind> kinds, LabelTimes& times) {
    const SonarAtPose then = pings.at_pose(sonar, p);
    TracedPing traced;
    for (int k = 0; k < 2; ++k) {  // the first warms the caches
        const double start = thread_seconds_now();
        traced = trace(*then, pings.scene, engine, pings.poses[p], pings.indices[p]);
        form_image(traced, then->settings, pings.scene, pings.key(p));
        if (k == 1) times.ping_ms.push_back(1e3 * (thread_seconds_now() - start));
    }
    const double t_s = assembly.trajectory[pings.indices[p]].t_s;
    const std::vector<ObjectSphere> spheres = spheres_at(annotated, assembly, t_s);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        LabelRequest request = kinds[i].request;
        if (request.annotations) request.annotated = spheres;
        request.surface = &annotated.surface;
        const double start = thread_seconds_now();
        label_ping(traced, then->settings, pings.scene, assembly.objects, engine, request);
        times.labels_ms[i].push_back(1e3 * (thread_seconds_now() - start));
    }
}

std::vector<LabelRow> rows_of(const std::string& sensor, std::span<const LabelKind> kinds,
                              std::span<const LabelTimes> poses) {
    std::vector<LabelRow> rows;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        std::vector<double> labels;
        std::vector<double> ratios;
        for (const LabelTimes& times : poses) {
            const double ping = median_summary(times.ping_ms).centre;
            labels.push_back(median_summary(times.labels_ms[i]).centre);
            ratios.push_back((ping + labels.back()) / ping);
        }
        rows.push_back({sensor, kinds[i].name, median_summary(labels), median_summary(ratios)});
    }
    return rows;
}

}  // namespace

std::vector<LabelRow> measure_labels(const Mission& mission, const Assembly& assembly,
                                     const ReportOptions& options, const ReportProgress& progress) {
    if (mission.output.labels.empty()) return {};
    const PingSet pings = make_ping_set(mission, assembly, options.poses);
    const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
    const AnnotatedObjects annotated = annotated_objects(assembly);
    const std::vector<LabelKind> kinds = label_kinds(assembly.bottom.get());
    std::vector<LabelRow> out;
    for (const Sonar& sonar : assembly.sonars) {
        progress(sonar.config.name + ": labels");
        std::vector<LabelTimes> poses(pings.poses.size());
        for (LabelTimes& times : poses)
            times.labels_ms.resize(kinds.size());
        for (int round = 0; round < options.rounds; ++round) {
            for (std::size_t p = 0; p < poses.size(); ++p)
                visit(pings, assembly, sonar, *engine, annotated, p, kinds, poses[p]);
        }
        const std::vector<LabelRow> rows = rows_of(sonar.config.name, kinds, poses);
        out.insert(out.end(), rows.begin(), rows.end());
    }
    return out;
}

}  // namespace sonarsim
