#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <tuple>
#include <utility>

#include "simulate/ping/sonar.h"
#include "simulate/product/picture.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

/// The frame of a sonar's fan: boresight up, port on the left, the apex in the middle column and
/// `range_max / pixel_m` pixels below the upper edge, the lower edge up to a sector of 180 degrees.
struct FanFrame {
    int width = 0;   ///< px
    int height = 0;  ///< px, at most twice the width
    double pixel_m = 0.0;
};

/// A frame `width_px` wide; a narrow sector is centred. 0: one pixel per range bin, at most 1024.
FanFrame fan_frame(const Sonar& sonar, int width_px = 0);

struct FanPlace {
    double x_m;  ///< ahead
    double y_m;  ///< to port
    double range_m;
    double azimuth_rad;
};
FanPlace fan_place(const FanFrame& frame, double range_max_m, double column, double row);
bool is_inside_sector(const View& view, const FanPlace& place);

/// The mapping from a sonar's bins to the pixels of its fan, made once per sonar. A pixel has the
/// bin at its centre, as on the displays of sonars, so that beams have steps at their borders and
/// the grain its whole contrast. A pixel that covers several bins in range or in azimuth has the
/// mean of as many, rounded, that are nearest. The area outside the sector is black, and edges are
/// smooth: 64 points sample the share of a pixel inside.
struct FanMap {
    /// A pixel of which a part lies outside the sector.
    struct Edge {
        std::uint32_t pixel;  ///< index among the pixels of its ring
        float covered;        ///< the share inside
    };
    struct Run {
        std::int32_t index;  ///< first pixel in the picture, row by row
        std::int32_t count;
    };
    /// Pixels that have the mean of equally many beams. Near the apex a pixel covers more beams.
    struct Ring {
        int beams = 1;
        std::vector<std::int32_t> pixels;  ///< the first bin of each in the padded image
        std::vector<Edge> edges;           ///< in the order of the pixels
        std::vector<Run> runs;             ///< places of the pixels in the picture, in order
    };

    FanFrame frame;
    int range_bins = 1;  ///< a pixel covers so many, rounded
    std::vector<Ring> rings;
    int range_padding = 0;   ///< rows before the first and after the last bin, so that pixels
    int beam_padding = 0;    ///< at the edges need no special case; the same for columns
    bool full_turn = false;  ///< the last beam is next to the first
};

/// `width_px` as for fan_frame().
FanMap make_fan_map(const Sonar& sonar, int width_px = 0);

/// Renders the fan as grey values [height, width], row by row from the top. Displays show
/// amplitude: grey = 255 sqrt(intensity / full_scale), white above `full_scale`.
std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale);

/// The fan as the sonar's own display shows it: the values of raw/ from 0 (black) to their largest
/// (white), or for a model without an instrument render_fan().
std::vector<std::uint8_t> display_fan(const FanMap& map, const EchoModel& model, const Ping& ping,
                                      double full_scale);

/// The bin at the centre of each pixel of a fan, for ids, which have no mean. An index into
/// [beams, range bins], beam after beam; -1 outside the sector.
struct FanBins {
    FanFrame frame;
    std::vector<std::int32_t> by_row;     ///< [height, width]
    std::vector<std::int32_t> by_column;  ///< [width, height]
    /// The box around the pixels of each bin; empty (left = right) for a bin between pixels.
    std::vector<PixelBox> boxes;
};

/// Makes the bins for the same fan as make_fan_map(sonar).
FanBins make_fan_bins(const Sonar& sonar);

/// The values of `by_beam` [beams, range bins] at a fan's pixels; `blank` outside the sector.
template <class T>
std::vector<T> fan_values(std::span<const std::int32_t> bins, const std::vector<T>& by_beam,
                          T blank) {
    std::vector<T> out(bins.size());
    for (std::size_t k = 0; k < bins.size(); ++k)
        out[k] = bins[k] < 0 ? blank : by_beam[static_cast<std::size_t>(bins[k])];
    return out;
}

/// The last results of a pure function by its arguments; variants of a job mostly ask for the same.
template <class Arguments, class Result>
class LastResults {
  public:
    template <class Make>
    Result get(Arguments arguments, Make make) {
        constexpr std::size_t capacity = 4;  // sonars of one vehicle
        const std::lock_guard lock(mutex_);
        auto found = std::ranges::find(kept_, arguments, &std::pair<Arguments, Result>::first);
        if (found == kept_.end()) {
            if (kept_.size() == capacity) kept_.erase(kept_.begin());
            kept_.emplace_back(std::move(arguments), make());
            found = kept_.end() - 1;
        }
        return found->second;
    }

  private:
    std::mutex mutex_;
    std::vector<std::pair<Arguments, Result>> kept_;
};

/// The fans that the variants of a mission share.
class FanStore {
  public:
    std::shared_ptr<const FanMap> map(const Sonar& sonar) {
        return maps_.get(borders_of(sonar),
                         [&] { return std::make_shared<const FanMap>(make_fan_map(sonar)); });
    }
    std::shared_ptr<const FanBins> bins(const Sonar& sonar) {
        return bins_.get(borders_of(sonar),
                         [&] { return std::make_shared<const FanBins>(make_fan_bins(sonar)); });
    }

  private:
    /// All that a fan's pixels depend on.
    using Borders = std::tuple<View, bool, std::vector<double>>;
    static Borders borders_of(const Sonar& sonar) {
        return {sonar.settings.view, sonar.equal_azimuth, sonar.azimuth_edges_rad};
    }

    LastResults<Borders, std::shared_ptr<const FanMap>> maps_;
    LastResults<Borders, std::shared_ptr<const FanBins>> bins_;
};

}  // namespace sonarsim
