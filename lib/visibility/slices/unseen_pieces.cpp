#include "visibility/slices/unseen_pieces.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// Pieces per height of the view, and the most pieces of a triangle.
constexpr float per_height = 8.0F;
constexpr float most_pieces = 4.0F;

}  // namespace

void add_unseen_pieces(const Corners& corners, const Eigen::Vector3f& normal, float reflection,
                       const Interval& view_w, std::vector<UnseenPiece>& out) {
    const Interval seen_u = u_between(corners, view_w);
    const auto [w_from, w_to] = std::minmax({corners[0].w, corners[1].w, corners[2].w});
    const Interval w{std::max(w_from, view_w.from), std::min(w_to, view_w.to)};
    const float height = -normal.dot(Eigen::Vector3f(corners[0].X, corners[0].U, corners[0].W));
    if (!(w.from < w.to) || height == 0.0F) return;
    const float pieces = std::clamp(
        std::ceil(per_height * (w.to - w.from) / (view_w.to - view_w.from)), 1.0F, most_pieces);
    const float step = (w.to - w.from) / pieces;
    for (int k = 0; k < static_cast<int>(pieces); ++k) {
        const float at = w.from + (static_cast<float>(k) + 0.5F) * step;
        const Interval across = u_between(corners, {at, at});
        if (!(across.from < across.to)) continue;
        const float u = 0.5F * (across.from + across.to);
        // On a plane -h q = n . (1, u, w), and dA = X^3 du dw / h.
        const auto q_at = [&](float v) -> float {
            return -(normal.x() + normal.y() * u + normal.z() * v) / height;
        };
        const auto range_at = [&](float v) -> float {
            return std::sqrt(1.0F + u * u + v * v) / q_at(v);
        };
        const float q = q_at(at);
        const float low = q_at(at - 0.5F * step);
        const float high = q_at(at + 0.5F * step);
        if (!(q > 0.0F && low > 0.0F && high > 0.0F)) continue;
        const auto [near, far] =
            std::minmax({range_at(at - 0.5F * step), range_at(at + 0.5F * step)});
        out.push_back({seen_u,
                       u,
                       at,
                       q,
                       (across.to - across.from) * step / (q * q * q * std::fabs(height)),
                       {near, far},
                       std::fabs(height),
                       reflection});
    }
}

}  // namespace sonarsim
