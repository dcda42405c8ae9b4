#pragma once

namespace sonarsim {

/// The pixels of an image in the coordinates of its map: the centre of the pixel in row r
/// and column c lies at (x_m + c * column_m, y_m + r * row_m).
struct PixelGrid {
    double x_m = 0.0;  ///< x of the centre of the first pixel of the first row
    double y_m = 0.0;
    double column_m = 1.0;  ///< from one column to the next; towards the east
    double row_m = -1.0;    ///< from one row to the next; negative: the first row is the north
};

}  // namespace sonarsim
