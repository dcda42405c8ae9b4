#include "visibility/slices/edge_line.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sonarsim {

namespace {

// Of an edge from behind the sensor: what is less of it lies across the picture is rounding.
constexpr float flattest = 1e-12F;

}  // namespace

EdgeLine edge_line(const Corner& p, const Corner& q, float nearest_m) {
    const bool swap = std::tie(p.X, p.U, p.W) < std::tie(q.X, q.U, q.W);
    const Corner& a = swap ? q : p;
    const Corner& b = swap ? p : q;
    EdgeLine line{a.u, a.w, 0.0F, 1.0F / a.X, 0.0F, {std::min(a.u, b.u), std::max(a.u, b.u)}};
    if (b.X > nearest_m) {
        const float across = b.u - a.u;
        // An edge that stands upright is met by no slice.
        if (across == 0.0F) return line;
        line.w_slope = (b.w - a.w) / across;
        line.q_slope = (1.0F / b.X - line.q) / across;
        return line;
    }
    const float dX = b.X - a.X;
    const float dU = b.U - a.U;
    const float dW = b.W - a.W;
    const float across = a.X * dU - a.U * dX;
    if (std::fabs(across) < flattest * a.X * a.X) return line;
    line.w_slope = (a.X * dW - a.W * dX) / across;
    line.q_slope = -dX / across;
    return line;
}

}  // namespace sonarsim
