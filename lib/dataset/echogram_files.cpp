#include <algorithm>

#include "dataset/folded_records.h"
#include "dataset/image_file.h"
#include "dataset/ping_files.h"
#include "dataset/products.h"
#include "product/echogram.h"

namespace sonarsim {

namespace {

/// What is held of the records at a time while they are turned on their side.
constexpr std::size_t block_values = std::size_t{1} << 24;

/// Range bins [first, first + count) over all pings: [count, pings].
std::vector<float> across_pings(FoldedRecords& records, std::size_t first, std::size_t count) {
    const std::size_t pings = records.rows();
    std::vector<float> block(count * pings);
    for (std::size_t k = 0; k < pings; ++k) {
        const std::vector<float>& ping = records.row(k);
        for (std::size_t i = 0; i < count; ++i)
            block[i * pings + k] = ping[first + i];
    }
    return block;
}

}  // namespace

void write_echogram(const Sonar& sonar, double full_scale, const RecordFile& file,
                    const std::filesystem::path& folder) {
    FoldedRecords records(file);
    const double white = white_of(records);
    const std::size_t pings = records.rows();
    const auto bins = static_cast<std::size_t>(sonar.config.range_bins);
    const EchogramFrame frame = echogram_frame(sonar.config, static_cast<int>(pings));
    Picture axis = echogram_axis(sonar.config, frame);
    ImageFile plain(folder / "echogram.png", static_cast<int>(pings), sonar.config.range_bins,
                    PixelKind::grey16);
    ImageFile view(folder / "echogram_view.png", frame.width, frame.height, PixelKind::rgb8);
    std::vector<Rgb> pixels(frame.width);
    const std::size_t at_once = std::clamp<std::size_t>(block_values / pings, 1, bins);
    int y = 0;
    for (std::size_t first = 0; first < bins; first += at_once) {
        const std::size_t count = std::min(at_once, bins - first);
        const std::vector<float> block = across_pings(records, first, count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::span<const float> row = std::span(block).subspan(i * pings, pings);
            plain.row(grey_16(row, full_scale));
            echogram_row(row, white, frame.ping_width, std::span(pixels).subspan(frame.axis_width));
            for (int k = 0; k < frame.range_height; ++k, ++y) {
                std::copy_n(axis.row(y), frame.axis_width, pixels.begin());
                view.row(pixels);
            }
        }
    }
    plain.finish();
    view.finish();
}

}  // namespace sonarsim
