#include "recording/arrays.h"

#include <cstdint>
#include <span>
#include <sstream>
#include <stdexcept>

#include "core/error.h"
#include "core/file.h"
#include "format/npy_reader.h"
#include "format/png_file.h"
#include "format/png_reader.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_array_file = std::size_t{1} << 31;

void require_few_values(std::size_t values) {
    if (values > most_recorded_values)
        throw std::runtime_error("has more than 268,435,456 values; split it, or take fewer pings");
}

RecordedArray array_of_npy(std::string_view bytes) {
    const NpyView view = read_npy(bytes);
    require_few_values(view.values);
    RecordedArray array{view.format.shape, {}};
    array.values.reserve(view.values);
    for (std::size_t k = 0; k < view.values; ++k)
        array.values.push_back(npy_value(view, k));
    return array;
}

RecordedArray array_of_png(std::string_view bytes) {
    constexpr std::size_t colour_type_at = 25;
    constexpr char colour_table = 3;
    if (bytes.size() > colour_type_at && bytes[colour_type_at] == colour_table)
        throw std::runtime_error("is a picture with a colour table; save its values in grey");
    std::istringstream stream{std::string(bytes)};
    RecordedArray array;
    const PngShape shape =
        read_png(stream, bytes.size(), [&](const PngShape& own, std::span<const std::uint8_t> row) {
            if (own.channels != 1)
                throw std::runtime_error("is a picture in colours; save its values in grey");
            require_few_values(array.values.size() + row.size());
            if (own.bits == 8) {
                array.values.insert(array.values.end(), row.begin(), row.end());
                return;
            }
            for (std::size_t k = 0; k + 1 < row.size(); k += 2)
                array.values.push_back(256.0 * row[k] + row[k + 1]);
        });
    array.shape = {static_cast<std::size_t>(shape.height), static_cast<std::size_t>(shape.width)};
    return array;
}

}  // namespace

RecordedArray read_array(std::string_view bytes, const std::string& name) {
    try {
        if (bytes.starts_with(png_signature)) return array_of_png(bytes);
        return array_of_npy(bytes);
    } catch (const std::runtime_error& fault) {
        throw InputError({name}, fault.what());
    }
}

RecordedArray read_array_file(const std::filesystem::path& path) {
    return read_array(read_file(path, largest_array_file), path.string());
}

}  // namespace sonarsim
