#include "dataset/folded_records.h"
#include "dataset/image_file.h"
#include "dataset/ping_files.h"
#include "dataset/products.h"
#include "product/sidescan_row.h"
#include "product/waterfall.h"

namespace sonarsim {

void write_waterfall(const Sonar& sonar, double full_scale, const RecordFile& file,
                     const std::filesystem::path& folder) {
    FoldedRecords records(file);
    const double white = white_of(records);
    Picture axis = waterfall_axis(sonar.config);
    const int rows = static_cast<int>(records.rows());
    ImageFile plain(folder / "waterfall.png", waterfall_columns(sonar.config), rows,
                    PixelKind::grey16);
    ImageFile view(folder / "waterfall_view.png", axis.width, axis.height + rows, PixelKind::rgb8);
    for (int y = 0; y < axis.height; ++y)
        view.row(std::span<const Rgb>(axis.row(y), axis.width));
    std::vector<Rgb> pixels(axis.width);
    for (int k = 0; k < rows; ++k) {
        const std::vector<float>& row = records.row(k);
        plain.row(grey_16(row, full_scale));
        waterfall_row(row, white, pixels);
        view.row(pixels);
    }
    plain.finish();
    view.finish();
}

}  // namespace sonarsim
