#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace sonarsim {

/// A place in a triangle: fractions of its edges from the first corner to the second and the third.
struct TrianglePlace {
    float u = 0.0F, v = 0.0F;
};

/// A part of a triangle: a trapezoid, or a triangle whose first and last corner are one.
struct TrianglePart {
    std::array<TrianglePlace, 4> corners;  ///< in order around it
    TrianglePlace centroid;
    float share;  ///< share of the triangle's area
};

/// Cuts a triangle into parts whose sides are no larger than 1: into strips along its shortest
/// side, and these across. A long and narrow triangle has as few parts as it needs. `size` is the
/// size of the side (u, v), `use` receives each part.
template <class Size, class Use>
void cut_triangle(Size size, Use use) {
    constexpr float most = 512.0F;
    constexpr std::array<TrianglePlace, 3> corners{{{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}}};
    // The size of the side opposite to each corner.
    const std::array<float, 3> sizes{size(-1.0F, 1.0F), size(0.0F, -1.0F), size(1.0F, 0.0F)};
    if (*std::ranges::max_element(sizes) <= 1.0F) {
        constexpr float third = 1.0F / 3.0F;
        return use(
            TrianglePart{{corners[0], corners[1], corners[2], corners[0]}, {third, third}, 1.0F});
    }
    const auto tip = static_cast<std::size_t>(std::ranges::min_element(sizes) - sizes.begin());
    const TrianglePlace t = corners[tip];
    const TrianglePlace a = corners[(tip + 1) % 3];
    const TrianglePlace b = corners[(tip + 2) % 3];
    const auto wanted = [&](float of_size) {
        return of_size > 1.0F ? static_cast<int>(std::ceil(std::min(of_size, most))) : 1;
    };
    const auto share_of = [](int part, int parts) {
        return static_cast<float>(part) / static_cast<float>(parts);
    };
    const int strips = wanted(std::max(sizes[(tip + 1) % 3], sizes[(tip + 2) % 3]));
    // The place at the share `along` of the line from the tip to a point of the side from a to b,
    // which lies at the share `across` of this side.
    const auto place = [&](float along, float across) -> TrianglePlace {
        return {t.u + along * (a.u - t.u + across * (b.u - a.u)),
                t.v + along * (a.v - t.v + across * (b.v - a.v))};
    };
    for (int strip = 0; strip < strips; ++strip) {
        const float near = share_of(strip, strips);
        const float far = share_of(strip + 1, strips);
        const int parts = wanted(sizes[tip] * far);
        const float share = (far * far - near * near) / static_cast<float>(parts);
        const float middle = 2.0F / 3.0F * (far + near * near / (far + near));
        for (int part = 0; part < parts; ++part) {
            const float left = share_of(part, parts);
            const float right = share_of(part + 1, parts);
            use(TrianglePart{
                {place(near, left), place(far, left), place(far, right), place(near, right)},
                place(middle, 0.5F * (left + right)),
                share});
        }
    }
}

}  // namespace sonarsim
