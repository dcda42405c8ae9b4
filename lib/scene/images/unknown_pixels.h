#pragma once

#include <cmath>
#include <optional>

namespace sonarsim {

/// Numbers beyond this are marks of unknown pixels, not values.
inline constexpr double huge_pixel = 1e30;

/// Finds the pixels that have no value. Many files mark them with the largest float, but write this
/// mark with few digits: then every huge value with the sign of the mark is unknown.
class UnknownPixels {
  public:
    /// A `no_data` of NaN is ignored, since NaN never is a value.
    explicit UnknownPixels(std::optional<double> no_data) {
        if (!no_data || std::isnan(*no_data)) return;
        no_data_ = no_data;
        as_float_ = static_cast<float>(*no_data);
    }

    bool has(float value) const {
        if (std::isnan(value)) return true;
        if (!no_data_) return false;
        if (value == as_float_) return true;
        return std::fabs(*no_data_) > huge_pixel && std::fabs(value) > huge_pixel &&
               (value < 0.0F) == (*no_data_ < 0.0);
    }

  private:
    std::optional<double> no_data_;
    float as_float_ = 0.0F;
};

}  // namespace sonarsim
