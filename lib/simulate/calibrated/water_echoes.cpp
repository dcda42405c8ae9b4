#include <numeric>

#include "core/lanes.h"
#include "simulate/calibrated/kind_echoes.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/sample_kinds.h"

namespace sonarsim {

namespace {

// The depth of a sonar in water without a surface, m.
constexpr float deep_m = 1e9F;
// The range at which a transducer is in its far field, m.
constexpr float far_m = 1e6F;

/// The stretch [from, to] of a ray between two depths. `per_depth`: length per metre of depth.
std::array<float, 2> stretch_between(float depth_m, float per_depth, float top_m, float bottom_m) {
    const float a = (top_m - depth_m) * per_depth;
    const float b = (bottom_m - depth_m) * per_depth;
    return {std::max(std::min(a, b), 0.0F), std::max(a, b)};
}

/// The scattering that each channel receives: of all directions less that behind surface.
class ReceivedWater {
  public:
    ReceivedWater(const CalibratedModel& model, const TracedPing& traced, const Scene& scene)
        : model_(model),
          sines_(model.beams->sines()),
          limits_(model.limits),
          down_(-traced.T_world_sensor.rotation.toRotationMatrix().row(2).cast<float>()),
          depth_m_(scene.water_surface ? static_cast<float>(scene.water_surface->height_m -
                                                            traced.T_world_sensor.translation.z())
                                       : deep_m),
          bins_per_m_(1.0F / model.equation.bin_m) {
        limits_.depth_m = 0.0F;
        if (sines_) {
            const int joined = model.water->joined_columns;
            channels_ = (sines_->columns - 1) / joined + 2;
            first_sine_ = static_cast<float>(sines_->first);
            channels_per_sine_ = static_cast<float>(1.0 / (joined * sines_->step));
            limits_.sine = 0.5F / channels_per_sine_;
        } else {
            channels_ = model.beams->columns();
            if (has_sides()) limits_.elevation_sine = 0.0F;
        }
        sums_.resize(channels_ * stride());
        far_.count = 1;
        far_echo_.range_m[0] = far_m;
        for (const Eigen::Vector3f& direction : model.water->directions.all)
            add(direction, 0.0F, model.water->directions.each_sr);
        end_at(traced.samples.items);
        for (int channel = 0; channel < channels_; ++channel) {
            float* const channel_sums = sums_.data() + channel * stride();
            std::partial_sum(channel_sums, channel_sums + stride(), channel_sums);
        }
    }

    /// The mean power of each bin of a column of the grid, up to a multiple of 8.
    std::vector<float> powers(int column) const {
        const int joined = model_.water->joined_columns;
        const int first = column / joined;
        const float part = 1.0F / static_cast<float>(joined);
        const float next = part * static_cast<float>(column % joined);
        const float* const one = sums_.data() + first * stride();
        const float* const other = one + (next > 0.0F ? stride() : 0);
        std::vector<float> out = model_.water->row_power;
        for (int row = 0; row < model_.equation.rows; ++row)
            out[row] *= part * std::fma(next, other[row] - one[row], one[row]);
        return out;
    }

  private:
    bool has_sides() const { return model_.instrument.beam.aperture == Aperture::port_starboard; }
    // One more row, for the part of a border in the last bin that belongs to the next.
    std::size_t stride() const { return model_.equation.rows + std::size_t{1}; }

    /// Takes away the water behind surface.
    void end_at(std::span<const Sample> surface) {
        for (const Sample& sample : surface) {
            if (!kind_of(sample.kind).hides) continue;
            const auto [range, direction] = arrival_of(sample.position);
            if (!(range > 0.0F)) continue;
            const int rows = patches_along(extents_of(sample.edge_u, direction), range, limits_);
            const int columns = patches_along(extents_of(sample.edge_v, direction), range, limits_);
            const float sr = sample.area_m2 * sample.height_m / (range * range * range);
            if (rows * columns == 1) {
                add(direction, range, -sr);
                continue;
            }
            const float piece_sr = sr / static_cast<float>(rows * columns);
            for_each_middle(rows, columns, [&](float s, float t) {
                const Arrival piece =
                    arrival_of(sample.position + s * sample.edge_u + t * sample.edge_v);
                add(piece.direction, piece.range_m, -piece_sr);
            });
        }
    }

    /// Adds the water of a solid angle about a direction, from a range on.
    void add(const Eigen::Vector3f& direction, float from_m, float angle_sr) {
        const float fall = down_.dot(direction);
        // A level ray is taken to fall a little.
        const float per_depth = 1.0F / (std::fabs(fall) < 1e-6F ? 1e-6F : fall);
        const float weighted_sr = angle_sr * model_.equation.elevation.at(direction.z());
        const std::array<ChannelShare, 2> shares = shares_of(direction);
        for (const WaterColumn::Layer& layer : model_.water->layers) {
            const auto [begin, end] =
                stretch_between(depth_m_, per_depth, layer.top_m, layer.bottom_m);
            if (!(end > from_m)) continue;
            for (const auto& [channel, share] : shares) {
                const float value = share * weighted_sr * layer.strength;
                add_from(std::max(begin, from_m), value, channel);
                add_from(end, -value, channel);
            }
        }
    }

    struct ChannelShare {
        int channel;
        float share;
    };

    std::array<ChannelShare, 2> shares_of(const Eigen::Vector3f& direction) {
        std::array<ChannelShare, 2> out{};
        if (sines_) {
            const float at = (direction.y() - first_sine_) * channels_per_sine_;
            const int first = static_cast<int>(at);
            const float next = at - static_cast<float>(first);
            if (at >= 0.0F && first < channels_ - 1)
                out = {{{first, 1.0F - next}, {first + 1, next}}};
            return out;
        }
        far_.x[0] = far_m * direction.x();
        far_.y[0] = far_m * direction.y();
        // A side-scan sonar's pattern along the track is in row_power.
        far_.z[0] = has_sides() ? 0.0F : far_m * direction.z();
        PatchBlock::Array<float> gain;
        for (int beam = 0; beam < channels_; ++beam) {
            model_.beams->find_gains(beam, far_, far_echo_, gain);
            out[beam] = {beam, gain[0]};
        }
        return out;
    }

    /// Adds a constant from a range on. The bin that the range cuts gets its share.
    void add_from(float range_m, float value, int channel) {
        const SonarEquation& bins = model_.equation;
        const float at = std::max((range_m - bins.range_min_m) * bins_per_m_, 0.0F);
        if (!(at < static_cast<float>(bins.rows))) return;
        const int row = static_cast<int>(at);
        const float later = (at - static_cast<float>(row)) * value;
        float* const here = sums_.data() + channel * stride() + row;
        here[0] += value - later;
        here[1] += later;
    }

    const CalibratedModel& model_;
    const SineGrid* sines_;    ///< the sines of a line array; null: transducers
    PointLimits limits_;       ///< for pieces of surface
    Eigen::RowVector3f down_;  ///< sensor frame
    float depth_m_;            ///< the sonar's
    float bins_per_m_;
    /// The beams of transducers. In a fan, joined columns; a direction between two belongs to both.
    int channels_ = 0;
    float first_sine_ = 0.0F, channels_per_sine_ = 0.0F;
    PatchBlock far_;  ///< a direction, as a place far away
    PointEchoes far_echo_;
    std::vector<float> sums_;  ///< [channels, rows + 1] changes from bin to bin, then values
};

}  // namespace

void add_reverberation(const CalibratedModel& model, const TracedPing& traced,
                       const FormContext& context, const EchoGrid& powers, PowerForm form,
                       float gain, EchoGrid& grid, EchoGrid* mean) {
    const Terms& terms = context.terms;
    std::optional<ReceivedWater> water;
    if (terms.direct && terms.water && model.water) water.emplace(model, traced, context.scene);
    if (!water && !(model.reverberation.share > 0.0F)) return;
    const PhiloxKey key = context.draws.of(stream_named("reverberation"));
    const auto rows = static_cast<std::size_t>(grid.rows());
    std::vector<float> drawn;
    for (int c = 0; c < grid.columns(); ++c) {
        if (water)
            drawn = water->powers(c);
        else
            drawn.assign((rows + lanes - 1) / lanes * lanes, 0.0F);
        add_tails(model.reverberation, powers.column(c), std::span(drawn).first(rows));
        add_drawn(form, drawn, gain, c, key, grid);
        if (mean) add_drawn(PowerForm::power, drawn, gain, c, key, *mean);
    }
}

}  // namespace sonarsim
