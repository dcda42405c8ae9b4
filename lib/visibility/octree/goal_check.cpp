#include "visibility/octree/goal_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "core/text.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// Number of pings of a view whose error is estimated. Each estimate costs a third of a ping.
constexpr std::size_t checked_pings = 8;

/// A hash of the pose: equal for equal poses.
std::uint64_t number_of(const Pose& pose) {
    const auto& q = pose.rotation.coeffs();
    const auto& t = pose.translation;
    std::uint64_t number = 0;
    for (const double x : {q[0], q[1], q[2], q[3], t[0], t[1], t[2]}) {
        const auto bits = std::bit_cast<std::uint64_t>(x);
        const PhiloxBlock block =
            philox({static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32U),
                    static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32U)},
                   {0, 0});
        number = std::uint64_t{block.x0} << 32U | block.x1;
    }
    return number;
}

std::string percent_text(double x) {
    return number_text(std::ceil(1e3 * x) / 10.0) + " %";
}

/// Rounds down to two digits.
double rounded_down(double x) {
    const double step = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
    return std::floor(x / step) * step;
}

std::string name_of_view(const View& view) {
    const auto deg = [](double rad) { return number_text(std::round(1e3 * degrees(rad)) / 1e3); };
    if (view.shape == ViewShape::cone) return "a cone of " + deg(view.azimuth_rad) + " degrees";
    return deg(view.azimuth_rad) + " x " + deg(view.elevation_rad) + " degrees";
}

}  // namespace

std::shared_ptr<double> GoalCheck::place_for(const View& view, const Pose& T_world_sensor) {
    auto known = std::ranges::find(views_, view, &OfView::view);
    if (known == views_.end()) known = views_.insert(known, {view, {}});
    auto& errors = known->errors;
    const std::uint64_t number = number_of(T_world_sensor);
    if (errors.contains(number)) return nullptr;
    if (errors.size() == checked_pings) {
        if (number > errors.rbegin()->first) return nullptr;
        errors.erase(std::prev(errors.end()));
    }
    return errors[number] = std::make_shared<double>(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::string> GoalCheck::warnings(double fixed_leaf_m) const {
    std::vector<std::string> all;
    for (const auto& [view, errors] : views_) {
        double sum = 0.0;
        double worst = 0.0;
        int above = 0;
        int known = 0;
        for (const auto& [number, error] : errors) {
            if (std::isnan(*error)) continue;
            ++known;
            sum += *error;
            worst = std::max(worst, *error);
            above += *error > view.relative_l1;
        }
        if (worst <= view.relative_l1) continue;
        const double mean = sum / known;
        all.push_back(
            "octree misses accuracy.relative_l1 (" + percent_text(view.relative_l1) + ") in " +
            std::to_string(above) + " of the " + std::to_string(known) +
            " pings that were checked in views of " + name_of_view(view) + ": off by about " +
            percent_text(mean) + " on average and " + percent_text(worst) + " at worst; " +
            (fixed_leaf_m > 0.0
                 ? "octree.leaf_m of " +
                       number_text(rounded_down(fixed_leaf_m * view.relative_l1 / worst)) +
                       " or engine: rays should meet it"
                 : "a lower accuracy.relative_l1 makes leaves smaller, or use engine: rays"));
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace sonarsim
