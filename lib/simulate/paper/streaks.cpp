#include "simulate/paper/streaks.h"

#include <algorithm>
#include <iterator>

#include "simulate/trace/arrivals.h"

namespace sonarsim {

RowAreas::RowAreas(int rows) : all(rows, 0.0F) {
    normal.clear(rows);
}

void RowAreas::add(const BinSums& beam) {
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] += beam.weight(i);
}

std::vector<Sample> at_normal_incidence(std::span<const Sample> samples, float min_cosine) {
    std::vector<Sample> out;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(out), [&](const Sample& s) {
        return s.height_m > min_cosine * arrival_range(s.position);
    });
    return out;
}

std::uint64_t add_streaks(std::span<float> image, const RowAreas& areas, const Streaks& streaks) {
    const std::size_t columns = image.size() / areas.all.size();
    std::uint64_t rows = 0;
    for (std::size_t i = 0; i < areas.all.size(); ++i) {
        const float needed = streaks.threshold * areas.all[i];
        if (!(areas.all[i] > 0.0F && areas.normal.weight(i) >= needed)) continue;
        ++rows;
        for (float& pixel : image.subspan(i * columns, columns)) {
            const float x = std::clamp(pixel, 0.0F, 1.0F);
            pixel = streaks.mode == StreakMode::add ? 1.0F - (1.0F - x) * (1.0F - x) : x * x;
        }
    }
    return rows;
}

}  // namespace sonarsim
