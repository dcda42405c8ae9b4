#include "visibility/slices/beam_errors.h"

#include <doctest/doctest.h>

#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "support/approx.h"
#include "visibility/slices/beam_check.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

/// Ten bins of 1 m from 0 to 10 m.
View ten_bins() {
    View view;
    view.range_max_m = 10.0;
    view.range_bins = 10;
    view.beams = 4;
    return view;
}

/// The expected error of surfaces with 1 m^2 per metre of range and intensity 1.
double error_of(const std::vector<Interval>& surfaces) {
    BeamErrors errors(ten_bins());
    errors.begin_beam(0);
    for (const Interval& range_m : surfaces)
        errors.sums().add(range_m, range_m.to - range_m.from, range_m.to, 1.0F);
    errors.finish();
    return errors.edge_bins();
}

/// One beam: the middle of each bin of `image`, and of each bin of its check.
BeamErrors errors_of_bins(const std::vector<int>& image, const std::vector<int>& check) {
    BeamErrors errors(ten_bins());
    const auto fill = [](int bin, BeamSums& sums) {
        const auto low = static_cast<float>(bin) + 0.25F;
        sums.add({low, low + 0.5F}, 1.0F, low + 0.5F, 1.0F);
    };
    errors.begin_beam(0);
    for (const int bin : image)
        fill(bin, errors.sums());
    BeamSums sums(ten_bins());
    for (const int bin : check)
        fill(bin, sums);
    errors.finish();
    errors.check(0, sums, 1.0);
    return errors;
}

}  // namespace

TEST_CASE("slices: bins that surface only just reaches count as errors") {
    // The surface fills bins 2 to 4, the last with 0.0005, 0.002 or half a bin.
    CHECK(error_of({{2.5F, 4.0005F}}) == test::approx(0.16 / 3.0).epsilon(1e-3));
    CHECK(error_of({{2.5F, 4.002F}}) == test::approx(0.09 / 3.0).epsilon(1e-3));
    CHECK(error_of({{2.5F, 4.5F}}) == 0.0);
    // Surface that ends just before the border fills two bins.
    CHECK(error_of({{2.5F, 3.9995F}}) == test::approx(0.26 / 2.0).epsilon(1e-3));
    // A sliver in a bin that another surface fills is harmless.
    CHECK(error_of({{2.5F, 4.0005F}, {4.2F, 4.9F}}) == 0.0);
    CHECK(error_of({}) == 0.0);
}

TEST_CASE("slices: the error of edge bins is that of the beams so far") {
    BeamErrors errors(ten_bins());
    errors.begin_beam(0);
    errors.sums().add({2.5F, 4.0005F}, 1.5005F, 4.0005F, 1.0F);
    CHECK(errors.edge_bins() == 0.0);
    errors.begin_beam(1);
    CHECK(errors.edge_bins() == test::approx(0.16 / 3.0).epsilon(1e-3));
    // Three more bins without sliver.
    errors.sums().add({6.5F, 8.5F}, 2.0F, 8.5F, 1.0F);
    errors.finish();
    CHECK(errors.edge_bins() == test::approx(0.16 / 6.0).epsilon(1e-3));
}

TEST_CASE("slices: a drawn beam has its check's image, and stands for its neighbours") {
    // Intensity is 1 everywhere. Beam 0 has bins 2 to 4 and its check bins 2 to 5: distance 1, of
    // two bins if a check has bins 3 to 5.
    const auto errors_with = [](const Interval& check_m, double weight) -> BeamErrors {
        BeamErrors errors(ten_bins());
        errors.begin_beam(0);
        errors.sums().add({2.5F, 4.5F}, 2.0F, 4.5F, 1.0F);
        errors.finish();
        BeamSums check(ten_bins());
        check.add(check_m, 1.0F, check_m.to, 1.0F);
        errors.check(0, check, weight);
        return errors;
    };
    const BeamErrors whole = errors_with({2.5F, 5.5F}, 1.0);
    CHECK(whole.of_checked() == test::approx(1.0 / 4.0));  // the check has four bins
    CHECK(whole.of_others() == 0.0);
    CHECK(whole.root_of_squares() == test::approx(1.0 / 4.0));
    const BeamErrors drawn = errors_with({3.5F, 5.5F}, 4.0);
    CHECK(drawn.of_checked() == test::approx(2.0 / 3.0));
    CHECK(drawn.of_others() == test::approx(3.0 * 2.0 / 3.0));
    CHECK(drawn.root_of_squares() == test::approx(std::sqrt(2.0) / 3.0));
}

TEST_CASE("slices: draws of equal weighted distances have no scatter, and certain beams add none") {
    // Each beam has bins 2 to 4, and its check one or two bins more: distances of 1 or 2.
    const auto deviation = [](const std::vector<std::pair<double, int>>& drawn) -> double {
        BeamErrors errors(ten_bins());
        for (int beam = 0; beam < std::ssize(drawn); ++beam) {
            errors.begin_beam(beam);
            errors.sums().add({2.5F, 4.5F}, 2.0F, 4.5F, 1.0F);
        }
        errors.finish();
        for (int beam = 0; beam < std::ssize(drawn); ++beam) {
            BeamSums check(ten_bins());
            const float to = 4.5F + static_cast<float>(drawn[beam].second);
            check.add({2.5F, to}, 1.0F, to, 1.0F);
            errors.check(beam, check, drawn[beam].first);
        }
        return errors.others_deviation();
    };
    CHECK(deviation({{4.0, 1}, {2.0, 2}}) == 0.0);
    CHECK(deviation({{4.0, 1}, {1.0, 1}, {4.0, 1}}) == 0.0);
    // Weighted distances of 2 and 4: half the squared difference, times 1 - 1 / 2. The checks have
    // 4 and 5 bins.
    CHECK(deviation({{2.0, 1}, {2.0, 2}}) == test::approx(std::sqrt(0.5 * 0.5 * 2.0 * 2.0) / 9.0));
}

TEST_CASE("slices: a further draw knows the others anew, and earlier checks remain") {
    // Beams 0 to 3 have bins 2 to 4, and their checks one bin more: distance 1 each.
    BeamErrors errors(ten_bins());
    for (int beam = 0; beam < 4; ++beam) {
        errors.begin_beam(beam);
        errors.sums().add({2.5F, 4.5F}, 2.0F, 4.5F, 1.0F);
    }
    errors.finish();
    CHECK(errors.occupied_bins() == 12.0);
    BeamSums check(ten_bins());
    check.add({2.5F, 5.5F}, 1.0F, 5.5F, 1.0F);
    errors.start_draw();
    errors.check(1, check, 4.0);
    CHECK(errors.of_others() == test::approx(3.0 / 13.0));
    errors.start_draw();
    CHECK(errors.of_others() == 0.0);
    errors.check(0, check, 3.0);
    CHECK(errors.draws() == 1);
    CHECK(errors.of_checked() == test::approx(2.0 / 14.0));
    CHECK(errors.of_others() == test::approx(2.0 / 14.0));
    CHECK(likely_error(errors) == test::approx(0.0023 + 2.0 / 14.0 * (1.0 + 1.414)));
    CHECK(likely_error_if_checked(errors) == test::approx(0.0023 + 4.0 / 14.0));
}

TEST_CASE("slices: the limit of few draws is that of Student's distribution") {
    // Three draws with weighted distances of 2, 4 and 2: two thirds of 2 degrees of freedom, and
    // Student's 95 % quantile for 1.33 is 4.3; the series gives 3.6. Seven draws: 4 degrees, 2.132.
    const auto times_deviation = [](int draws) -> double {
        View view = ten_bins();
        view.beams = draws;
        BeamErrors errors(view);
        for (int beam = 0; beam < draws; ++beam) {
            errors.begin_beam(beam);
            errors.sums().add({2.5F, 4.5F}, 2.0F, 4.5F, 1.0F);
        }
        errors.finish();
        errors.start_draw();
        for (int beam = 0; beam < draws; ++beam) {
            BeamSums check(view);
            const float to = beam % 2 == 0 ? 5.5F : 6.5F;
            check.add({2.5F, to}, 1.0F, to, 1.0F);
            errors.check(beam, check, 2.0);
        }
        const double above = estimated_error(errors) - likely_error(errors);
        const double bins = 1.645 * 0.853 * errors.root_of_squares();
        return std::sqrt(above * above - bins * bins) / (1.414 * errors.others_deviation());
    };
    CHECK(times_deviation(3) > 3.0);
    CHECK(times_deviation(7) == test::approx(2.132).epsilon(0.02));
    CHECK(times_deviation(61) == test::approx(1.684).epsilon(0.01));
}

TEST_CASE("slices: neighbours that err alike are one run") {
    // Bins 1 and 2 are too bright, 3 too dark, 7 too dark: runs of 2, 1 and 1 of three bins'
    // signal.
    const BeamErrors errors = errors_of_bins({1, 2, 5}, {3, 5, 7});
    CHECK(errors.occupied_bins() == 3.0);
    CHECK(errors.of_checked() == test::approx(4.0 / 3.0));
    CHECK(errors.root_of_runs() == test::approx(std::sqrt(6.0) / 3.0));
    CHECK(errors.root_of_squares() == test::approx(2.0 / 3.0));
    CHECK(errors_of_bins({4}, {4}).root_of_runs() == 0.0);
}

TEST_CASE("slices: the limit of few bins is that of Student's distribution over runs") {
    // n equal runs of one bin: D = n x and r = sqrt(n) x. The limit is D + t 0.853 r, where the 95
    // % quantiles of Student's distribution for 4 and 5 degrees of freedom are 2.132 and 2.015.
    const auto times_r = [](const BeamErrors& errors) -> double {
        const double above = estimated_error_of_few_bins(errors) - likely_error(errors);
        return above / (0.853 * errors.root_of_runs());
    };
    CHECK(times_r(errors_of_bins({1, 5}, {3, 7})) == test::approx(2.132).epsilon(0.02));
    CHECK(times_r(errors_of_bins({1, 5}, {3, 7, 9})) == test::approx(2.015).epsilon(0.02));
    // One run decides alone: above 6 standard deviations in theory, 4.6 by the series.
    CHECK(times_r(errors_of_bins({1, 2}, {2})) > 4.0);
    CHECK(estimated_error_of_few_bins(errors_of_bins({2}, {2})) == test::approx(0.0023));
    // Three bins: at a goal of 3 % one of them is more than the goal allows.
    CHECK(few_bins_decide(errors_of_bins({1}, {3, 5, 7}), 0.03));
    CHECK(!few_bins_decide(errors_of_bins({1}, {3, 5, 7}), 3.0));
}
