#include "simulate/visibility/slices/edge_line.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sonarsim {

namespace {

// An edge from behind the sensor with a smaller extent across the picture plane than this is
// vertical to within rounding.
constexpr float flattest = 1e-12F;

/// The point at `nearest_m` on the edge from a, in front, to b.
Corner crossing(const Corner& a, const Corner& b, float nearest_m) {
    const float share = (nearest_m - a.X) / (b.X - a.X);
    const float U = a.U + share * (b.U - a.U);
    const float W = a.W + share * (b.W - a.W);
    return {nearest_m, U, W, U / nearest_m, W / nearest_m, 1.0F / nearest_m};
}

}  // namespace

EdgeLine edge_line(const Corner& p, const Corner& q, float nearest_m) {
    const bool swap = std::tie(p.X, p.U, p.W) < std::tie(q.X, q.U, q.W);
    const Corner& a = swap ? q : p;
    const Corner& b = swap ? p : q;
    EdgeLine line{a.u, a.w, 0.0F, a.q, 0.0F, {std::min(a.u, b.u), std::max(a.u, b.u)}};
    if (b.X > nearest_m) {
        const float across = b.u - a.u;
        // No slice meets a vertical edge.
        if (across == 0.0F) return line;
        line.w_slope = (b.w - a.w) / across;
        line.q_slope = (b.q - line.q) / across;
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

FrontPart part_in_front(const Corners& c, float nearest_m) {
    FrontPart part;
    const auto add = [&](const Corner& corner, int side) {
        part.corners[part.count] = corner;
        part.sides[part.count++] = side;
    };
    for (int i = 0; i < 3; ++i) {
        const Corner& a = c[i];
        const Corner& b = c[(i + 1) % 3];
        const bool a_in = a.X > nearest_m;
        const bool b_in = b.X > nearest_m;
        if (a_in) add(a, i);
        if (a_in && !b_in) add(crossing(a, b, nearest_m), FrontPart::cut);
        if (b_in && !a_in) add(crossing(b, a, nearest_m), i);
    }
    return part;
}

Interval u_between(const Corners& corners, const Interval& w) {
    Interval u{unbounded, -unbounded};
    const auto widen = [&](float to) { u = {std::min(u.from, to), std::max(u.to, to)}; };
    for (int k = 0; k < 3; ++k) {
        const Corner& a = corners[k];
        const Corner& b = corners[(k + 1) % 3];
        if (w.from <= a.w && a.w <= w.to) widen(a.u);
        for (const float border : {w.from, w.to}) {
            if ((a.w < border) != (b.w < border))
                widen(a.u + (border - a.w) / (b.w - a.w) * (b.u - a.u));
        }
    }
    return u;
}

}  // namespace sonarsim
