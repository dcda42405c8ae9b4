#include "simulate/calibrated/beams/beamformer.h"
#include "simulate/calibrated/receiver/receiver_chain.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "support/statistics.h"

namespace {

/// The sines of 2 half + 1 beams, `step` apart.
std::vector<double> even_sines(int half, double step) {
    std::vector<double> sines;
    for (int j = -half; j <= half; ++j)
        sines.push_back(j * step);
    return sines;
}

}  // namespace

TEST_CASE("fourier: the definition, and the inverse") {
    for (const int size : {2, 3, 5, 8, 12, 20, 24, 32, 40, 64}) {
        const Fourier fourier(size);
        std::vector<ComplexLanes> data(size), scratch(size);
        for (int n = 0; n < size; ++n) {
            for (int lane = 0; lane < lanes; ++lane) {
                data[n].re[lane] = static_cast<float>(std::sin(1.7 * n + lane));
                data[n].im[lane] = static_cast<float>(std::cos(0.3 * n * n - lane));
            }
        }
        const std::vector<ComplexLanes> before = data;
        fourier.forward(data.data(), scratch.data());
        for (int k = 0; k < size; ++k) {
            std::complex<double> sum = 0.0;
            for (int n = 0; n < size; ++n) {
                sum += std::complex<double>(before[n].re[3], before[n].im[3]) *
                       std::polar(1.0, -2.0 * pi * k * n / size);
            }
            CHECK(std::abs(sum - std::complex<double>(data[k].re[3], data[k].im[3])) < 2e-5);
        }
        fourier.backward(data.data(), scratch.data());
        for (int n = 0; n < size; ++n)
            CHECK(std::fabs(data[n].re[5] / static_cast<float>(size) - before[n].re[5]) < 1e-5);
    }
}

TEST_CASE("beams: noise has the power asked for and the correlation of the aperture") {
    // A uniform aperture: complex amplitudes are correlated by sinc(u L), powers by its square.
    const LineArray array = line_array(radians(0.4), -13.3);
    std::vector<double> sines;
    sines.reserve(256);
    for (int j = 0; j < 256; ++j)
        sines.push_back((j - 127.5) / 255.0);
    const Beamformer beams(array, sines, false);
    Beamformer::Scratch scratch(beams);
    std::vector<Lanes> out(beams.beams());
    const std::vector<float> row_sigma(2000, beams.element_sigma_of_unit());
    ElementNoise noise = beams.noise_of_ping(row_sigma, {1.0F}, {5, 6});
    std::vector<double> powers, neighbours;
    for (int row = 0; row < 2000; row += lanes) {
        beams.form(nullptr, row, &noise, scratch, out.data());
        for (int j = 20; j < 235; ++j) {
            for (int lane = 0; lane < lanes; ++lane) {
                powers.push_back(out[j][lane]);
                neighbours.push_back(out[j + 1][lane]);
            }
        }
    }
    CHECK(std::fabs(mean(powers) - 1.0) < 0.01);
    CHECK(std::fabs(std::pow(deviation(powers), 2.0) - 1.0) < 0.03);
    const double t = array.wavelengths / 255.0;
    const double sinc = std::sin(pi * t) / (pi * t);
    CHECK(std::fabs(correlation(powers, neighbours) - sinc * sinc) < 0.02);
}

TEST_CASE("beams: echoes between the columns have the energy of the pattern on average") {
    // The mean over places of the sum over beams is the integral of the pattern over the sine,
    // by the beams' distance. Columns are as far apart as they get.
    const LineArray array = line_array(radians(1.0), -30.0);
    const double step = 0.69 / array.wavelengths;
    const Beamformer beams(array, even_sines(40, step), false);
    EchoGrid grid(lanes, beams.grid().columns);
    const int middle = beams.grid().columns / 2;
    for (int lane = 0; lane < lanes; ++lane) {
        const float share = (static_cast<float>(lane) + 0.5F) / lanes;
        grid.column(middle)[2 * lane] = 1.0F - share;
        grid.column(middle + 1)[2 * lane] = share;
    }
    Beamformer::Scratch scratch(beams);
    std::vector<Lanes> out(beams.beams());
    beams.form(&grid, 0, nullptr, scratch, out.data());
    const double received =
        std::accumulate(out.begin(), out.end(), 0.0,
                        [](double sum, const Lanes& powers) { return sum + total(powers); }) /
        lanes;
    const double pattern = integral(-40.0, 40.0, 8000, [&](double beam) {
        return std::pow(line_pattern(array, beam * step), 2.0);
    });
    CHECK(std::fabs(received / pattern - 1.0) < 0.003);
}

TEST_CASE("beams: out of focus amplitudes and powers have Fresnel's pattern, and all energy") {
    // The pattern of a uniform aperture of W wavelengths with the phase q (2 x)^2 is the square of
    // the integral of exp(i (q (2 x)^2 + 2 pi x W u)) over x from -1/2 to 1/2. By Parseval's
    // theorem its integral over u does not depend on q. Columns are fine.
    constexpr int half = 150;
    const LineArray array = line_array(radians(0.5), -13.3);
    const double step = 0.1 / array.wavelengths;
    for (const double phase : {4.0, -11.0}) {
        const auto pattern = [&](bool powers, int row) {
            const std::vector<double> defocus{0.0, phase};
            const Beamformer beams(array, even_sines(half, step), powers, {}, defocus);
            EchoGrid grid(2 * lanes, beams.grid().columns);
            grid.column(static_cast<int>(
                std::lround(-beams.grid().first / beams.grid().step)))[2 * row] = 1.0F;
            Beamformer::Scratch scratch(beams);
            std::vector<Lanes> out(beams.beams());
            beams.form(&grid, row / lanes * lanes, nullptr, scratch, out.data());
            std::vector<double> bins;
            for (const Lanes& bin : out)
                bins.push_back(bin[row % lanes]);
            return bins;
        };
        for (const bool powers : {false, true}) {
            const std::vector<double> in_focus = pattern(powers, 5);
            const std::vector<double> out_of_focus = pattern(powers, lanes + 2);
            for (int j = 0; j <= 2 * half; ++j) {
                const std::complex<double> sum = integral(-0.5, 0.5, 1000, [&](double x) {
                    return std::polar(1.0, 4.0 * phase * x * x + 0.2 * pi * x * (j - half));
                });
                CHECK(std::fabs(out_of_focus[j] / in_focus[half] - std::norm(sum)) < 0.01);
            }
            CHECK(total(out_of_focus) == approx(total(in_focus)).epsilon(0.02));
        }
    }
}

TEST_CASE("companding: the laws at several powers, and an offset that makes zeros") {
    const std::vector<float> powers{0.0F, 1e-4F, 1.0F / 256, 1.0F / 16, 1.0F, 7.0F};
    using Raw = std::vector<std::uint16_t>;
    ReceiverConfig receiver;
    CHECK(companded(powers, receiver) == Raw{0, 26, 64, 128, 255, 255});
    receiver.offset = 0.25;
    CHECK(companded(powers, receiver) == Raw{0, 0, 0, 64, 191, 191});
    receiver.offset = 0.0;
    receiver.companding = Companding::linear;
    CHECK(companded(powers, receiver) == Raw{0, 3, 16, 64, 255, 255});
    // With the knee k = 0.2: k + (1 - k) (1 - exp(-(v - k) / (1 - k))), at v = 1/4, 1 and sqrt(7).
    receiver.knee = 0.2;
    CHECK(companded(powers, receiver) == Raw{0, 3, 16, 63, 180, 245});
    receiver.knee = 1.0;
    receiver.companding = Companding::log;
    receiver.bits = 12;
    // 1 + 20 log(amplitude) / 60 of 4095.
    CHECK(companded(powers, receiver) == Raw{0, 1365, 2451, 3273, 4095, 4095});
}
