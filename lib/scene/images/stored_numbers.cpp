#include "scene/images/stored_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <utility>

#include "scene/images/image.h"
#include "scene/images/tiff_tags.h"
#include "scene/images/unknown_pixels.h"

namespace sonarsim {

namespace {

constexpr std::uint16_t bits_of_sample_tag = 258;
constexpr std::uint16_t photometric_tag = 262;  // PhotometricInterpretation
constexpr std::uint16_t samples_tag = 277;
constexpr std::uint16_t palette_tag = 320;
constexpr std::uint16_t sample_format_tag = 339;  // SampleFormat

constexpr int zero_is_white = 0;
constexpr int zero_is_black = 1;
constexpr int red_green_blue = 2;
constexpr int of_palette = 3;

int number_or(const TiffTags& tags, std::uint16_t tag, int fallback) {
    const auto found = tags.numbers.find(tag);
    if (found == tags.numbers.end() || found->second.empty()) return fallback;
    return static_cast<int>(std::clamp(found->second.front(), -1.0, 65536.0));
}

/// A file has palette entries of 16 bits: 257 or 256 times a colour of 8 bits, so that the upper
/// byte is the colour in both cases. Some writers store the 8 bits unscaled; then no entry reaches
/// 256.
std::vector<std::array<float, 3>> palette_of(const TiffTags& tags, int bits,
                                             const Location& where) {
    const auto found = tags.numbers.find(palette_tag);
    const std::size_t count = std::size_t{1} << bits;
    if (found == tags.numbers.end() || found->second.size() != 3 * count)
        throw InputError(where, "has pixels of a palette without its colours; export it as PNG");
    const std::vector<double>& entries = found->second;
    const bool has_8_bits = *std::ranges::max_element(entries) < 256.0;
    std::vector<std::array<float, 3>> palette(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double entry = entries[c * count + i];
            palette[i][c] = static_cast<float>(has_8_bits ? entry : std::floor(entry / 256.0));
        }
    }
    return palette;
}

StoredNumbers stored_in_tiff(const std::filesystem::path& path, const Location& where) {
    const TiffTags tags = read_tiff_tags(
        path, {bits_of_sample_tag, photometric_tag, samples_tag, palette_tag, sample_format_tag});
    StoredNumbers out;
    const int bits = number_or(tags, bits_of_sample_tag, 1);
    if (bits != 8 && bits != 16 && bits != 32 && bits != 64) out.bits = bits;
    if (out.bits != 0 && (number_or(tags, sample_format_tag, 1) != 1 || bits < 1 || bits > 16)) {
        throw InputError(where, "has numbers of " + std::to_string(bits) +
                                    " bits, which are read up to 16 and without a sign; write it "
                                    "anew with gdal_translate -ot Float32");
    }
    const int photometric = number_or(tags, photometric_tag, zero_is_black);
    if (photometric == zero_is_black || photometric == red_green_blue) return out;
    if (photometric != zero_is_white && photometric != of_palette) {
        throw InputError(where,
                         "has colours in another form than red, green and blue, which would not "
                         "stay exact; export it as PNG");
    }
    if (photometric == of_palette) {
        if (number_or(tags, samples_tag, 1) != 1)
            throw InputError(where, "has a palette and more channels; export it as PNG");
        if (bits > 16) throw InputError(where, "has a palette of more than 16 bits");
        out.palette = palette_of(tags, bits, where);
    }
    out.photometric_offset = tags.places.at(photometric_tag);
    const auto word = static_cast<char>(zero_is_black);
    out.photometric_bytes = tags.is_big_endian ? std::array{'\0', word} : std::array{word, '\0'};
    return out;
}

StoredNumbers stored_in_png(const std::filesystem::path& path) {
    // 16 bytes of signature and of the head's length and name, then 8 bytes of width and height.
    std::array<char, 26> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    const bool is_grey = start[25] == 0;
    StoredNumbers out;
    const auto bits = static_cast<unsigned char>(start[24]);
    if (is_grey && bits < 8) out.bits = bits;
    return out;
}

/// Undoes the scaling of numbers to the range of their type: v * most_in_type / most_in_file,
/// rounded down.
void undo_scaling(int bits, Image& image) {
    const auto most_in_file = static_cast<double>((1 << bits) - 1);
    const auto most_in_type = static_cast<double>((1 << image.bits) - 1);
    for (float& value : image.values)
        value = static_cast<float>(
            std::round(static_cast<double>(value) * most_in_file / most_in_type));
    image.bits = bits;
}

void apply_palette(const std::vector<std::array<float, 3>>& palette, const Location& where,
                   Image& image) {
    const bool has_alpha = image.reference.no_data.has_value();
    const std::size_t channels = has_alpha ? 4 : 3;
    if (image.values.size() > most_image_values / channels) {
        throw InputError(where,
                         "has more than 2^24 pixels of a palette; make it coarser with "
                         "gdal_translate -outsize 50% 50%, or cut a part out with -projwin");
    }
    const UnknownPixels unknown(image.reference.no_data);
    image.reference.no_data.reset();
    std::vector<float> colours;
    colours.reserve(channels * image.values.size());
    for (const float value : image.values) {
        const auto index = static_cast<std::size_t>(value);
        if (index >= palette.size())
            throw InputError(where, "has pixels beyond its palette; export it again");
        colours.insert(colours.end(), palette[index].begin(), palette[index].end());
        if (has_alpha) colours.push_back(unknown.has(value) ? 0.0F : 255.0F);
    }
    image.values = std::move(colours);
    image.channels = static_cast<int>(channels);
    image.bits = 8;
}

}  // namespace

StoredNumbers read_stored_numbers(const std::filesystem::path& path, const std::string& format,
                                  const Location& where) {
    if (format == "tiff") return stored_in_tiff(path, where);
    return format == "png" ? stored_in_png(path) : StoredNumbers();
}

void restore_numbers(const StoredNumbers& stored, const Location& where, Image& image) {
    const bool holds_numbers = image.channels <= 2 && !image.is_float;
    if (stored.bits > 0 && stored.bits < image.bits && holds_numbers)
        undo_scaling(stored.bits, image);
    if (stored.palette.empty()) return;
    if (image.channels != 1 || image.is_float)
        throw InputError(where, "has a palette and more than one channel; export it as PNG");
    apply_palette(stored.palette, where, image);
}

}  // namespace sonarsim
