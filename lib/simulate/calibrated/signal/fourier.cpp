#include "simulate/calibrated/signal/fourier.h"

#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

struct Value {
    Floats8 re, im;
};

Value load(const ComplexLanes& z) {
    return {Floats8::load(z.re.data()), Floats8::load(z.im.data())};
}

void store(ComplexLanes& z, const Value& v) {
    v.re.store(z.re.data());
    v.im.store(z.im.data());
}

Value operator+(const Value& a, const Value& b) {
    return {a.re + b.re, a.im + b.im};
}

Value operator-(const Value& a, const Value& b) {
    return {a.re - b.re, a.im - b.im};
}

/// a times the root (re, im), conjugated for the inverse.
template <bool inverse>
Value turned(const Value& a, float re, float im) {
    const Floats8 c = re;
    const Floats8 s = inverse ? -im : im;
    return {fms(a.re, c, a.im * s), fma(a.re, s, a.im * c)};
}

/// a times -i, or i for the inverse.
template <bool inverse>
Value quarter_turned(const Value& a) {
    if (inverse) return {Floats8(0.0F) - a.im, a.re};
    return {a.im, Floats8(0.0F) - a.re};
}

Value operator*(float a, const Value& b) {
    return {a * b.re, a * b.im};
}

/// a + b c
Value plus(const Value& a, float b, const Value& c) {
    return {fma(b, c.re, a.re), fma(b, c.im, a.im)};
}

/// The transform of 3 or 5 numbers that lie `step` apart.
template <bool inverse>
std::array<Value, 3> transform_3(const ComplexLanes* in, std::ptrdiff_t step) {
    constexpr float sine = 0.866025404F;  // sine of a third of a turn
    const Value a = load(in[0]);
    const Value b = load(in[step]);
    const Value c = load(in[2 * step]);
    const Value sum = b + c;
    const Value even = plus(a, -0.5F, sum);
    const Value odd = quarter_turned<inverse>(sine * (b - c));
    return {a + sum, even + odd, even - odd};
}

template <bool inverse>
std::array<Value, 5> transform_5(const ComplexLanes* in, std::ptrdiff_t step) {
    // Cosines and sines of one and of two fifths of a turn.
    constexpr float c1 = 0.309016994F, c2 = -0.809016994F;
    constexpr float s1 = 0.951056516F, s2 = 0.587785252F;
    const Value a = load(in[0]);
    const Value b = load(in[step]);
    const Value c = load(in[2 * step]);
    const Value d = load(in[3 * step]);
    const Value e = load(in[4 * step]);
    const Value be = b + e;
    const Value cd = c + d;
    const Value even1 = plus(plus(a, c1, be), c2, cd);
    const Value even2 = plus(plus(a, c2, be), c1, cd);
    const Value odd1 = quarter_turned<inverse>(plus(s1 * (b - e), s2, c - d));
    const Value odd2 = quarter_turned<inverse>(plus(s2 * (b - e), -s1, c - d));
    return {a + be + cd, even1 + odd1, even2 + odd2, even2 - odd2, even1 - odd1};
}

int odd_part(int size) {
    while (size % 2 == 0)
        size /= 2;
    return size;
}

}  // namespace

Fourier::Fourier(int size) : size_(size) {
    for (int k = 0; k < size; ++k) {
        const SinCos root = sincos(-2.0 * pi * k / size);
        roots_.push_back({static_cast<float>(root.cos), static_cast<float>(root.sin)});
    }
}

template <bool inverse, int radix>
void Fourier::odd_step(const ComplexLanes* from, ComplexLanes* to) const {
    const int part = size_ / radix;
    for (int p = 0; p < part; ++p) {
        ComplexLanes* const out = to + static_cast<std::ptrdiff_t>(radix) * p;
        const auto values = [&] {
            if constexpr (radix == 3) {
                return transform_3<inverse>(from + p, part);
            } else {
                return transform_5<inverse>(from + p, part);
            }
        }();
        store(out[0], values[0]);
        for (int r = 1; r < radix; ++r) {
            const Root w = roots_[static_cast<std::size_t>(r) * p];
            store(out[r], turned<inverse>(values[r], w.re, w.im));
        }
    }
}

/// Stockham's algorithm: steps of radix 4, and one of radix 3 or 5 and one of radix 2 where the
/// size needs them. Each reads and writes an array in order, without bit reversal.
template <bool inverse>
void Fourier::transform(ComplexLanes* data, ComplexLanes* scratch) const {
    ComplexLanes* from = data;
    ComplexLanes* to = scratch;
    int length = size_;
    int stride = 1;
    if (const int odd = odd_part(size_); odd > 1) {
        if (odd == 3) {
            odd_step<inverse, 3>(from, to);
        } else {
            odd_step<inverse, 5>(from, to);
        }
        std::swap(from, to);
        length /= odd;
        stride = odd;
    }
    while (length >= 4) {
        const int quarter = length / 4;
        for (int p = 0; p < quarter; ++p) {
            const Root w1 = roots_[static_cast<std::size_t>(p) * stride];
            const Root w2 = roots_[static_cast<std::size_t>(2) * p * stride];
            const Root w3 = roots_[static_cast<std::size_t>(3) * p * stride];
            const ComplexLanes* const in = from + static_cast<std::ptrdiff_t>(stride) * p;
            ComplexLanes* const out = to + static_cast<std::ptrdiff_t>(stride) * 4 * p;
            const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(stride) * quarter;
            for (int q = 0; q < stride; ++q) {
                const Value a = load(in[q]);
                const Value b = load(in[q + step]);
                const Value c = load(in[q + 2 * step]);
                const Value d = load(in[q + 3 * step]);
                const Value ac = a + c;
                const Value bd = b + d;
                const Value ac_ = a - c;
                const Value bd_ = quarter_turned<inverse>(b - d);
                store(out[q], ac + bd);
                store(out[q + stride], turned<inverse>(ac_ + bd_, w1.re, w1.im));
                store(out[q + 2 * stride], turned<inverse>(ac - bd, w2.re, w2.im));
                store(out[q + 3 * stride], turned<inverse>(ac_ - bd_, w3.re, w3.im));
            }
        }
        std::swap(from, to);
        length /= 4;
        stride *= 4;
    }
    if (length == 2) {
        for (int q = 0; q < stride; ++q) {
            const Value a = load(from[q]);
            const Value b = load(from[q + stride]);
            store(to[q], a + b);
            store(to[q + stride], a - b);
        }
        std::swap(from, to);
    }
    if (from != data) std::copy_n(from, size_, data);
}

void Fourier::forward(ComplexLanes* data, ComplexLanes* scratch) const {
    transform<false>(data, scratch);
}

void Fourier::backward(ComplexLanes* data, ComplexLanes* scratch) const {
    transform<true>(data, scratch);
}

int transform_size(int count) {
    int size = 2;
    while (size < count)
        size *= 2;
    // Five eighths or three quarters of it may suffice.
    if (size >= 16 && size / 8 * 5 >= count) return size / 8 * 5;
    if (size >= 8 && size / 4 * 3 >= count) return size / 4 * 3;
    return size;
}

}  // namespace sonarsim
