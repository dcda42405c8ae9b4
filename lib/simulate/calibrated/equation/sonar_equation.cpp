#include "simulate/calibrated/equation/sonar_equation.h"

#include "core/decibel.h"
#include "core/lanes.h"
#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/line_array.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// `exp_neg` of bottom.h, 8 at a time; a compiled loop over it takes twice as long.
Floats8 exp_neg_of_8(Floats8 x, float longest = exp_neg_cutoff) {
    const Floats8 turns = min(x, longest) * 1.44269504F;
    const Floats8 whole = floor(turns);
    const Floats8 rest = (turns - whole) * 0.69314718F;
    Floats8 series = -1.0F / 5040;
    for (const float term : {1.0F / 720, -1.0F / 120, 1.0F / 24, -1.0F / 6, 1.0F / 2, -1.0F, 1.0F})
        series = fma(series, rest, term);
    const Floats8 scale = floats_of_bits((Ints8(127) - to_ints(whole)) << 23);
    return where(x < longest, series * scale);
}

/// One value of every material. Up to 8 materials are looked up in one register.
class MaterialTable {
  public:
    MaterialTable(std::span<const Backscatter> materials, float Backscatter::*value)
        : materials_(materials), value_(value), first_(0.0F) {
        std::array<float, lanes> first{};
        for (std::size_t m = 0; m < std::min(materials.size(), first.size()); ++m)
            first[m] = materials[m].*value;
        first_ = Floats8::load(first.data());
    }

    /// The values of 8 materials.
    Floats8 at(const std::uint32_t* numbers) const {
        if (materials_.size() <= lanes)
            return picked(first_, Ints8::load(reinterpret_cast<const std::int32_t*>(numbers)));
        std::array<float, lanes> values;
        for (int lane = 0; lane < lanes; ++lane)
            values[lane] = materials_[numbers[lane]].*value_;
        return Floats8::load(values.data());
    }

  private:
    std::span<const Backscatter> materials_;
    float Backscatter::*value_;
    Floats8 first_;
};

/// `Backscatter::at`, 8 at a time.
class BackscatterTable {
  public:
    explicit BackscatterTable(const Scattering& scattering)
        : lambert_(scattering.materials, &Backscatter::lambert),
          facet_(scattering.materials, &Backscatter::facet),
          inverse_slope2_(scattering.materials, &Backscatter::inverse_slope2),
          sea_beds_(scattering.sea_beds.empty() ? nullptr : scattering.sea_beds.data()) {}

    /// Adds two kinds of scattering; the one that a material does not have is 0. Neighbours mostly
    /// have one material, so one of the two can be skipped.
    Floats8 at(const std::uint32_t* numbers, Floats8 sine) const {
        const Floats8 lambert = lambert_.at(numbers);
        const Floats8 facet = facet_.at(numbers);
        if (sea_beds_ == nullptr) return by_rule(numbers, lambert, facet, sine);
        constexpr unsigned all = 0xFFU;
        const unsigned ruled = (Floats8(0.0F) < lambert + facet).bits();
        if (ruled == all) return by_rule(numbers, lambert, facet, sine);
        const Floats8 tabled = by_table(numbers, sine);
        return ruled == 0U ? tabled : by_rule(numbers, lambert, facet, sine) + tabled;
    }

  private:
    Floats8 by_rule(const std::uint32_t* numbers, Floats8 lambert, Floats8 facet,
                    Floats8 sine) const {
        const Floats8 s2 = sine * sine;
        const Floats8 inverse = Floats8(1.0F) / max(s2, 1e-6F);
        const Floats8 steepness = inverse_slope2_.at(numbers) * (inverse - 1.0F);
        const Floats8 facets = facet * (inverse * inverse) * exp_neg_of_8(steepness);
        return fma(lambert, s2, facets);
    }

    Floats8 by_table(const std::uint32_t* numbers, Floats8 sine) const {
        const Ints8 material = Ints8::load(reinterpret_cast<const std::int32_t*>(numbers));
        // In this order of arguments NaN becomes 0.
        const Floats8 root = sqrt(min(max(Floats8(1.0F) - sine, 0.0F), 1.0F));
        const Floats8 at = root * (1.0F * AngularTable::steps);
        const Floats8 whole = floor(at);
        const auto [here, next] =
            table_entries(sea_beds_, material * AngularTable::size + to_ints(whole));
        return fma(at - whole, next - here, here);
    }

    MaterialTable lambert_, facet_, inverse_slope2_;
    const float* sea_beds_;  ///< null: none
};

}  // namespace

SineTable elevation_pattern(double width_rad, double side_lobe_db, const ElementsConfig& elements,
                            double floor_db) {
    if (width_rad <= 0.0) return {};
    // The mean over instruments: one draw of the errors of so few elements would move the nulls.
    const LineArray array = line_array(width_rad, side_lobe_db);
    const double floor = mean_side_lobe(array, elements) + power_of_db(floor_db);
    return sine_table(-1.0, 1.0, [&](double sine) {
        const double amplitude = line_pattern(array, sine);
        return amplitude * amplitude + floor;
    });
}

float SineTable::at(float sine) const {
    if (values.empty()) return 1.0F;
    // In this order of arguments NaN becomes 0.
    const float where = std::min(1.0F * steps, std::max(0.0F, (sine - from) * per_unit));
    const float whole = std::floor(where);
    const float* const entry = values.data() + static_cast<int>(whole);
    return std::fma(where - whole, entry[1] - entry[0], entry[0]);
}

void weigh_by_elevation(const SineTable& pattern, const PatchBlock& pieces, int count,
                        PointEchoes& echoes) {
    if (pattern.values.empty()) return;
    const float* const table = pattern.values.data();
    // Interpolates between the entries at a sine within [-1, 1].
    const Floats8 half = 0.5F * SineTable::steps;
    for (int k = 0; k < count; k += lanes) {
        const Floats8 sine =
            Floats8::load(pieces.z.data() + k) / Floats8::load(echoes.range_m.data() + k);
        // In this order of arguments NaN becomes 0.
        const Floats8 at = min(max(fma(half, sine, half), 0.0F), 1.0F * SineTable::steps);
        const Floats8 whole = floor(at);
        const auto [here, next] = table_entries(table, to_ints(whole));
        const Floats8 power = fma(at - whole, next - here, here);
        float* const to = echoes.power.data() + k;
        (Floats8::load(to) * power).store(to);
    }
}

std::uint64_t apply_sonar_equation(const PatchBlock& pieces, const Scattering& scattering,
                                   const SonarEquation& equation, PointEchoes& echoes) {
    const int count = (pieces.count + lanes - 1) / lanes * lanes;
    echoes.count = count;
    const float per_bin = 1.0F / equation.bin_m;
    const BackscatterTable strengths(scattering);
    for (int k = 0; k < count; k += lanes) {
        const auto read = [&](const PatchBlock::Array<float>& from) {
            return Floats8::load(from.data() + k);
        };
        const Floats8 range = piece_range(read(pieces.x).v, read(pieces.y).v, read(pieces.z).v);
        const Floats8 inverse = Floats8(1.0F) / range;
        const Floats8 spreading = inverse * inverse;
        const Floats8 sine = min(read(pieces.height_m) * inverse, 1.0F);
        const Floats8 received = read(pieces.area_m2) * (spreading * spreading);
        const Floats8 loss =
            exp_neg_of_8(fms(equation.loss_per_m, range, equation.ln_headroom), min_loss);
        const Floats8 power = strengths.at(pieces.material.data() + k, sine) * loss * received;
        range.store(echoes.range_m.data() + k);
        // In this order of arguments NaN stays NaN.
        min(max_echo, power).store(echoes.power.data() + k);
        fms(range - equation.range_min_m, per_bin, 0.5F).store(echoes.row.data() + k);
    }
    weigh_by_elevation(equation.elevation, pieces, count, echoes);
    const auto rows = static_cast<float>(equation.rows);
    int outside = 0;
    for (int k = 0; k < count; ++k) {
        const bool inside = echoes.row[k] > -0.5F && echoes.row[k] < rows - 0.5F;
        const bool is_piece = k < pieces.count;
        outside += is_piece && !inside ? 1 : 0;
        const bool kept = is_piece && inside;
        echoes.power[k] = kept ? echoes.power[k] : 0.0F;
        echoes.row[k] = kept ? echoes.row[k] : 0.0F;
    }
    return outside;
}

}  // namespace sonarsim
