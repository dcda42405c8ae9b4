#include "calibrated/drawn_powers.h"

#include <array>

#include "calibrated/lanes.h"
#include "calibrated/normals.h"

namespace sonarsim {

namespace {

/// Adds to 8 bins of a column.
void add_eight(PowerForm form, Floats8 power, float half_gain, int row, int column, PhiloxKey key,
               float* cells) {
    std::array<float, std::size_t{2} * lanes> added;
    if (form == PowerForm::power) {
        store_complex(power, 0.0F, added.data());
    } else {
        std::array<std::uint32_t, lanes> a, b;
        for (int lane = 0; lane < lanes; ++lane) {
            a[lane] = static_cast<std::uint32_t>(row + lane);
            b[lane] = static_cast<std::uint32_t>(column);
        }
        philox_pairs(a.data(), b.data(), lanes, key);
        Lanes re, im;
        complex_normals(a.data(), re, im);
        const Floats8 amplitude = sqrt(half_gain * power);
        store_complex(amplitude * Floats8::load(re.data()), amplitude * Floats8::load(im.data()),
                      added.data());
    }
    (Floats8::load(cells) + Floats8::load(added.data())).store(cells);
    (Floats8::load(cells + lanes) + Floats8::load(added.data() + lanes)).store(cells + lanes);
}

}  // namespace

void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid) {
    float* const cells = grid.column(column);
    for (std::size_t row = 0; row < powers.size(); row += lanes) {
        const Floats8 power = greatest(Floats8::load(powers.data() + row), 0.0F);
        add_eight(form, power, 0.5F * gain, static_cast<int>(row), column, key, cells + 2 * row);
    }
}

}  // namespace sonarsim
