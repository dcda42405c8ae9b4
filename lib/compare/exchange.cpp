#include "compare/exchange.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compare/reduced.h"
#include "core/in_parallel.h"
#include "core/random.h"

namespace sonarsim {

namespace {

constexpr std::size_t exchange_draws = 499;

/// True if a draw exchanges a place.
bool is_exchanged(std::size_t draw, int place, std::uint32_t seed) {
    const PhiloxBlock block = philox(
        {static_cast<std::uint32_t>(draw), static_cast<std::uint32_t>(place), 0, 0x73776170U},
        {seed, 0});
    return (block.x0 & 1U) != 0;
}

/// The cells of both recordings; those of the simulated one have negative pings.
Measured both_of(const ExchangedFigure& figure) {
    Measured out = *figure.real;
    for (Cell cell : figure.simulated->cells) {
        cell.ping = -1 - cell.ping;
        out.cells.push_back(cell);
    }
    sort_quantile(out);
    return out;
}

/// The size of the standardised difference as it is, and in each draw.
std::vector<double> standardised_differences(const ExchangedFigure& figure, std::uint32_t seed) {
    std::vector<double> out(exchange_draws + 1);
    if (!(figure.error > 0.0)) return out;
    const Measured both = both_of(figure);
    int places = 0;
    for (const Cell& cell : both.cells)
        places = std::max(places, cell.location + 1);
    std::vector<char> exchanged(static_cast<std::size_t>(places));
    for (std::size_t draw = 0; draw <= exchange_draws; ++draw) {
        for (int place = 0; draw > 0 && place < places; ++place)
            exchanged[static_cast<std::size_t>(place)] = is_exchanged(draw, place, seed) ? 1 : 0;
        const auto of_side = [&](bool is_real) {
            return reduced(both, [&](const Cell& cell) {
                const bool swaps = exchanged[static_cast<std::size_t>(cell.location)] != 0;
                return ((cell.ping >= 0) != swaps) == is_real ? static_cast<double>(cell.weight)
                                                              : 0.0;
            });
        };
        const double off = std::fabs(of_side(false) - of_side(true)) / figure.error;
        out[draw] = std::isfinite(off) ? off : 0.0;
    }
    return out;
}

}  // namespace

std::vector<double> exchange_p(const std::vector<ExchangedFigure>& figures, std::uint32_t seed) {
    std::vector<std::vector<double>> sizes(figures.size());
    in_parallel(figures.size(),
                [&](std::size_t k) { sizes[k] = standardised_differences(figures[k], seed); });
    // From the smallest difference up: each is compared with those that are not larger.
    std::vector<std::size_t> order(figures.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return sizes[k][0]; });
    std::vector<double> greatest(exchange_draws + 1);
    std::vector<double> out(figures.size());
    for (const std::size_t k : order) {
        double as_great = 1.0;
        for (std::size_t draw = 1; draw <= exchange_draws; ++draw) {
            greatest[draw] = std::max(greatest[draw], sizes[k][draw]);
            as_great += greatest[draw] >= sizes[k][0] ? 1.0 : 0.0;
        }
        out[k] = as_great / (exchange_draws + 1.0);
    }
    // A figure is no more significant than one with a larger difference.
    for (std::size_t i = order.size(); i-- > 1;)
        out[order[i - 1]] = std::max(out[order[i - 1]], out[order[i]]);
    return out;
}

}  // namespace sonarsim
