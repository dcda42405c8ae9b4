#pragma once

#include "core/lanes.h"
#include "core/random.h"
#include "core/units.h"

namespace sonarsim {

/// natural_log(), 8 at a time.
inline Floats8 natural_log_of_8(Floats8 x) {
    const Ints8 bits = bits_of_floats(x);
    const Ints8 exponent = halved(bits - 0x3f3504f3, 23);
    const Floats8 m = floats_of_bits(bits - (exponent << 23));
    const Floats8 s = (m - 1.0F) / (m + 1.0F);
    const Floats8 series = polynomial_of_8(s * s, {1.0F / 9, 1.0F / 7, 1.0F / 5, 1.0F / 3, 1.0F});
    return fma(2.0F * s, series, to_floats(exponent) * 0.69314718056F);
}

/// Complex numbers, 8 of them.
struct Complexes8 {
    Floats8 re, im;
};

/// `sincos_small`, 8 at a time: the cosines and the sines.
inline Complexes8 unit_vectors_of_8(Floats8 angle) {
    const Floats8 y = 0.5F * angle;
    const Floats8 t = y * y;
    const Floats8 s = y * polynomial_of_8(t, {-1.0F / 39916800, 1.0F / 362880, -1.0F / 5040,
                                              1.0F / 120, -1.0F / 6, 1.0F});
    const Floats8 c = polynomial_of_8(t, {1.0F / 479001600, -1.0F / 3628800, 1.0F / 40320,
                                          -1.0F / 720, 1.0F / 24, -1.0F / 2, 1.0F});
    return {Floats8(1.0F) - 2.0F * s * s, 2.0F * s * c};
}

/// normal_pair() of 8 random words as complex numbers: real and imaginary part have variance 1.
inline Complexes8 complex_normals(Ints8 words) {
    const Floats8 upper = to_floats(words >> 12);
    const Floats8 lower = to_floats(words & 0xFFF);
    const Floats8 radius = sqrt(-2.0F * natural_log_of_8((upper + 0.5F) * 0x1p-20F));
    const auto [re, im] =
        unit_vectors_of_8(static_cast<float>(2.0 * pi) * ((lower + 0.5F) * 0x1p-12F - 0.5F));
    return {radius * re, radius * im};
}

inline Ints8 load_words(const std::uint32_t* words) {
    return Ints8::load(reinterpret_cast<const std::int32_t*>(words));
}

/// Bins of a column whose normals are drawn together, since a counter gives two random words.
inline constexpr int drawn_together = 2 * lanes;

/// Complex normal numbers of `drawn_together` bins of a column, from `row` on, a multiple of it.
inline std::array<Complexes8, 2> column_normals(int row, int column, PhiloxKey key) {
    alignas(32) std::array<std::uint32_t, lanes> a, b;
    for (int lane = 0; lane < lanes; ++lane) {
        a[lane] = static_cast<std::uint32_t>(row + lane);
        b[lane] = static_cast<std::uint32_t>(column);
    }
    philox_pairs(a.data(), b.data(), lanes, key);
    return {complex_normals(load_words(a.data())), complex_normals(load_words(b.data()))};
}

}  // namespace sonarsim
