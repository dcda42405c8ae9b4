#include "visibility/engine_by_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonarsim {

namespace {

class EngineByView final : public VisibilityEngine {
  public:
    EngineByView(std::shared_ptr<const VisibilityEngine> of_others, std::vector<EngineOfView> views)
        : of_others_(std::move(of_others)), views_(std::move(views)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const auto known = std::ranges::find(views_, view, &EngineOfView::view);
        if (known == views_.end()) return of_others_->visible_surface(view, T_world_sensor);
        View asked = view;
        asked.relative_l1 = known->goal;
        Samples samples = known->engine->visible_surface(asked, T_world_sensor);
        if (!std::isnan(known->error)) samples.estimated_l1 = known->error;
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        of_others_->intersect(T_world_sensor, rays, intersections);
    }

  private:
    std::shared_ptr<const VisibilityEngine> of_others_;
    std::vector<EngineOfView> views_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine_by_view(
    std::shared_ptr<const VisibilityEngine> of_others, std::vector<EngineOfView> views) {
    return std::make_unique<EngineByView>(std::move(of_others), std::move(views));
}

}  // namespace sonarsim
