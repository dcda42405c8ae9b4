#include "visibility/slices/check_beams.h"

#include <algorithm>
#include <numeric>

#include "visibility/slices/beam_draw.h"
#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

// Views of up to this many beams are checked whole, since one of their beams may have a large share
// of the error. Set after a drawn lattice of 64 beams was missed with 16 of them.
constexpr int few_beams = 64;

// The number of beams that are drawn first. Further draws aim at twice as many checked beams, and
// at `least_more` more at least, since each draw alone estimates the beams that are left: with 8
// more, the drawn lattice 20112 missed its goal without a warning. Chosen for cost, on all beams of
// each ping of the lifeboat, the wreck and the tank.
constexpr double first_draws = 8.0;
constexpr double least_more = 24.0;

// A beam's rate is at least `least_share_of_rate` of the mean rate. The rest of the rate is
// proportional to the disagreement of the beam's slices, up to `most_times_the_mean` times the mean
// disagreement. Chosen on the same three scenes, whose estimates have 0.71, 0.83 and 0.87 of the
// standard deviation that equal rates give.
constexpr double least_share_of_rate = 0.5;
constexpr double most_times_the_mean = 8.0;

/// A beam of a frame that may have errors.
struct Uncertain {
    SweptFrame* frame;
    std::size_t index;
    double difference;
};

std::vector<Uncertain> uncertain_beams(std::deque<SweptFrame>& frames) {
    std::vector<Uncertain> out;
    for (SweptFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.uncertain().size(); ++i)
            out.push_back({&frame, i, frame.uncertain()[i].difference});
    }
    return out;
}

/// Draws about `count` of the beams, each with the least rate or more, and checks them. Returns the
/// others.
std::vector<Uncertain> draw_and_check(const std::vector<Uncertain>& beams, double count,
                                      double least_rate, std::uint32_t number, BeamErrors& errors) {
    double sum = 0.0;
    for (const Uncertain& beam : beams)
        sum += beam.difference;
    const double mean = sum / static_cast<double>(beams.size());
    const double mean_rate = count / static_cast<double>(beams.size());
    std::vector<Uncertain> others;
    errors.start_draw();
    BeamDraw draw(number);
    for (const Uncertain& beam : beams) {
        const double times =
            mean > 0.0 ? std::min(beam.difference / mean, most_times_the_mean) : 1.0;
        const double own = least_share_of_rate + (1.0 - least_share_of_rate) * times;
        const double rate = mean_rate < 1.0 ? std::max(mean_rate * own, least_rate) : 1.0;
        const double weight = draw.weight(rate);
        if (weight > 0.0) {
            beam.frame->check(beam.index, weight);
        } else {
            others.push_back(beam);
        }
    }
    return others;
}

}  // namespace

bool draws_beams(const View& view) {
    return view.beams > few_beams && is_coarse(view.relative_l1);
}

void check_drawn(std::deque<SweptFrame>& frames, double goal, BeamErrors& errors) {
    std::vector<Uncertain> others = uncertain_beams(frames);
    const auto all = static_cast<double>(others.size());
    double count = first_draws;
    for (std::uint32_t number = 0; !others.empty(); ++number) {
        // A draw of too few bins would miss the errors of the other beams. The least rate is such
        // that, if the image just meets its goal, the drawn beams hold as many wrong bins as one
        // cause makes.
        const double least_rate = share_with_one_cause(errors, goal);
        const double more = count - (all - static_cast<double>(others.size()));
        others = draw_and_check(others, std::max(more, 1.0), least_rate, number, errors);
        // The first draws are too few to stop after them.
        const bool hopeless = number > 0 && likely_error_if_checked(errors) > goal;
        if (estimated_error(errors) <= goal || hopeless) break;
        count += std::max(count, least_more);
    }
}

void sweep_and_draw(const SlicesPing& ping, std::span<const SliceFrame> frames, double goal,
                    SlicesImage& image) {
    std::deque<SweptFrame> swept;
    for (const SliceFrame& frame : frames)
        swept.emplace_back(ping, frame, image);
    image.errors.finish();
    check_drawn(swept, goal, image.errors);
    for (const SweptFrame& frame : swept)
        image.samples.dropped += frame.dropped();
}

void replace_checked(bool keeps_compared, SlicesImage& image) {
    const std::vector<int>& checked = image.checked;
    if (checked.empty()) return;
    Samples& samples = image.samples;
    std::vector<std::size_t> order(checked.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return checked[i]; });
    std::vector<Sample> items;
    items.reserve(samples.items.size() + image.checked_samples.items().size());
    auto next = order.begin();
    std::uint32_t begin = 0;
    for (int beam = 0; beam + 1 < std::ssize(samples.beam_begin); ++beam) {
        const std::uint32_t end = samples.beam_begin[beam + 1];
        const auto before = std::span<const Sample>(samples.items).subspan(begin, end - begin);
        const auto of_beam = items.size();
        const bool is_checked = next != order.end() && checked[*next] == beam;
        if (!is_checked) items.insert(items.end(), before.begin(), before.end());
        for (; next != order.end() && checked[*next] == beam; ++next) {
            const std::span<const Sample> row = image.checked_samples[*next];
            items.insert(items.end(), row.begin(), row.end());
        }
        if (is_checked && keeps_compared) {
            const auto from = items.begin() + static_cast<std::ptrdiff_t>(of_beam);
            samples.compared.push_back({beam, {before.begin(), before.end()}, {from, items.end()}});
        }
        begin = end;
        samples.beam_begin[beam + 1] = static_cast<std::uint32_t>(items.size());
    }
    samples.items = std::move(items);
}

}  // namespace sonarsim
