#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of scene.seabed, and of the maps that apply to the ground, as in mission.h.

namespace sonarsim {

// A sea bed that is made by numbers and the mission's seed. Pairs are limits of draws.

/// An isotropic power spectrum of heights, W(K) = strength / (K^2 + (2 pi / corner)^2)^(exponent/2)
/// with K in rad/cm and W in cm^4, so that the integral of W over the plane is the variance.
struct BedRoughnessConfig {
    double spectral_strength_cm4 = 0.003;
    double spectral_exponent = 3.25;
    double corner_m = 2.0;  ///< wavelength above which the spectrum is flat
};

struct BedRippleConfig {
    double height_m = 0.0;  ///< from trough to crest
    double length_m = 0.0;  ///< from crest to crest
    double direction_deg = 0.0;
};

struct BedRockConfig {
    double density_per_m2 = 0.0;
    std::array<double, 2> diameter_m{};
    double exponent = 3.0;                   ///< rocks larger than D are as frequent as D^-exponent
    std::array<double, 2> buried{0.2, 0.6};  ///< share of a rock's height
    std::string material = {};
};

struct BedSedimentConfig {
    std::string material;
    double share = 1.0;
};

struct SeabedConfig {
    std::optional<std::array<double, 2>> size_m;  ///< x, y; none: the bed has no end
    double cell_m = 0.0;                          ///< distance between heights
    double z_m = 0.0;                             ///< mean height
    std::string material;
    std::string class_name;
    std::optional<BedRoughnessConfig> roughness;
    std::optional<BedRippleConfig> ripples;
    std::vector<BedSedimentConfig> sediments;
    double patch_m = 10.0;  ///< size of the patches of sediments
    std::optional<BedRockConfig> rocks;
    std::filesystem::path preset;  ///< empty after reading: its keys are filled in
    Location place = {};
};

/// The instance that a seabed makes, besides its rocks.
inline constexpr const char* seabed_instance = "seabed";

void describe(auto& v, BedRoughnessConfig& c) {
    v.number(
        "spectral_strength_cm4", c.spectral_strength_cm4, between(0, 100),
        "strength w of the spectrum of heights, W(K) = w / (K^2 + K0^2)^(g/2) for K in rad/cm, "
        "as the materials' column of this name has it; the integral of W over all wave "
        "vectors is the variance of the heights");
    v.number("spectral_exponent", c.spectral_exponent, {2, 5, false},
             "exponent g of this spectrum; APL-UW TR 9407 has 2.4 to 3.9, and 3.25 where nothing "
             "is known");
    v.number("corner_m", c.corner_m, above(0),
             "wavelength 2 pi / K0 above which the spectrum is flat");
}

void describe(auto& v, BedRippleConfig& c) {
    v.number("height_m", c.height_m, between(0, 100), "height from trough to crest", required);
    v.number("length_m", c.length_m, above(0), "length from crest to crest", required);
    v.number("direction_deg", c.direction_deg, any_angle_deg,
             "direction across the crests, from x towards y");
}

void describe(auto& v, BedSedimentConfig& c) {
    v.text("material", c.material, "its material", required);
    v.number("share", c.share, above(0), "its share of the bed, as a part of the sum of all shares",
             required);
}

void describe(auto& v, BedRockConfig& c) {
    v.number("density_per_m2", c.density_per_m2, between(0, 1e4),
             "mean number per square metre, as in a Poisson process", required);
    v.array("diameter_m", c.diameter_m, between(1e-3, 1e3),
            "least and largest diameter of the ball around a rock", required);
    v.number("exponent", c.exponent, between(0.1, 20),
             "exponent q of the power law: rocks above the diameter D are as frequent as D^-q");
    v.number("buried", c.buried, between(0, 0.95), "share of a rock's height below the bed");
    v.text("material", c.material,
           "material of the rocks; default: that of the bed, or of its first sediment");
    v.require(c.diameter_m[0] <= c.diameter_m[1], {"diameter_m"},
              "'diameter_m' is the least and the largest; the first must not be above the second");
}

void describe(auto& v, SeabedConfig& c) {
    v.path("preset", c.preset,
           "YAML file with keys of this section, such as those of configs/seabeds; keys given here "
           "override those of the file");
    v.array("size_m", c.size_m, above(0),
            "extent along x and y from the south-west corner at (0, 0); without it the bed has no "
            "end. No more of it is made than the sonars reach and objects need");
    v.number("cell_m", c.cell_m, between(1e-3, 1e3), "distance between neighbouring heights",
             required);
    v.number("z_m", c.z_m, any_position_m, "mean height of the bed");
    v.text("material", c.material, "material of the bed; default: scene.material_default");
    v.text("class", c.class_name, "class of the bed, for labels");
    v.section("roughness", c.roughness, "random heights of all wavelengths");
    v.section("ripples", c.ripples, "sand ripples");
    v.list_of("sediments", c.sediments, 0,
              "materials in patches; each borders on those before and after it in the list");
    v.number("patch_m", c.patch_m, above(0), "size of the patches of sediments");
    v.section("rocks", c.rocks, "rocks that lie on the bed, each an object");
    v.require(!c.ripples || c.ripples->length_m >= 4.0 * c.cell_m, {"cell_m", "ripples"},
              "ripples need 4 cells from crest to crest; lower cell_m");
    v.require(c.material.empty() || c.sediments.empty(), {"material", "sediments"},
              "give material or sediments, not both");
    v.require(c.sediments.size() <= 255, {"sediments"}, "a seabed has at most 255 sediments");
}

/// Pairs of a name and its replacement, in the order of the file.
using Renaming = std::vector<std::pair<std::string, std::string>>;

/// An image that applies to the ground from above. Pixels of a backscatter map are decibels.
struct AppliedMapConfig {
    std::filesystem::path file;
    double pixel_m = 0.0;              ///< size of a pixel; 0: by the file
    std::array<double, 2> origin_m{};  ///< point of the map that is the world's (0, 0)
    Location place = {};
};

struct SedimentMapConfig : AppliedMapConfig {
    Renaming materials;  ///< from a pixel's value or its colour to a material
};

/// The keys that say where an image lies.
void describe_image_place(auto& v, AppliedMapConfig& c) {
    v.number("pixel_m", c.pixel_m, above(0),
             "size of a pixel; `auto` takes the GeoTIFF tags or the world file", or_auto);
    v.array("origin_m", c.origin_m, any_position_m,
            "coordinates of the map that become x = 0, y = 0; with pixel_m from its south-west "
            "corner");
}

void describe(auto& v, AppliedMapConfig& c) {
    v.path("file", c.file, "an image, PNG, TIFF (GeoTIFF) or OpenEXR, whose first row is the north",
           required);
    describe_image_place(v, c);
}

void describe(auto& v, SedimentMapConfig& c) {
    describe(v, static_cast<AppliedMapConfig&>(c));
    v.text("materials", c.materials,
           "the material of each value, as {1: sand, 2: gravel}, or of each colour, as "
           "{\"#c8b478\": sand}");
    v.require(!c.materials.empty(), {"materials"},
              "'materials' must name the material of each value of the image, as {1: sand}");
}

}  // namespace sonarsim
