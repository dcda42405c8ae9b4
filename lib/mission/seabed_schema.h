#pragma once

#include "mission/limits.h"
#include "mission/seabed_config.h"

// The keys of scene.seabed. As in mission/schema.h.

namespace sonarsim {

template <class Visitor>
void describe(Visitor& v, BedRoughnessConfig& c) {
    v.number(
        "spectral_strength_cm4", c.spectral_strength_cm4, between(0, 100),
        "strength w of the spectrum of heights, W(K) = w / (K^2 + K0^2)^(g/2) for K in rad/cm, "
        "as the materials' column of this name has it; the integral of W over all wave "
        "vectors is the variance of the heights");
    v.number("spectral_exponent", c.spectral_exponent, {2, 5, false},
             "exponent g of this spectrum; 2.4 to 3.9 were measured, with 3.25 in the middle");
    v.number("corner_m", c.corner_m, above(0),
             "wavelength 2 pi / K0 above which the spectrum is flat");
}

template <class Visitor>
void describe(Visitor& v, BedRippleConfig& c) {
    v.number("height_m", c.height_m, between(0, 100), "height from trough to crest", required);
    v.number("length_m", c.length_m, above(0), "length from crest to crest", required);
    v.number("direction_deg", c.direction_deg, any_angle_deg,
             "direction across the crests, from x towards y");
    v.number("spread", c.spread, between(0, 0.5),
             "deviation of the wave vector, as a share of its length: crests bend, and end at 6.3 "
             "(spread / length_m)^2 places per square metre");
    v.number("share", c.share, between(0, 1), "share of the bed that has these ripples");
    v.number("patch_m", c.patch_m, above(0), "size of the patches that have them");
}

template <class Visitor>
void describe(Visitor& v, SeabedConfig& c) {
    v.place(c.place);
    v.optional_numbers("size_m", c.size_m, above(0),
                       "extent along x and y; without it the bed has no end. In both cases no more "
                       "of it is made than the sonars reach and objects need");
    v.number("cell_m", c.cell_m, between(1e-3, 1e3), "distance between neighbouring heights",
             required);
    v.numbers(
        "origin_m", c.origin_m, any_position_m,
        "the point of the bed that becomes x = 0, y = 0 of the mission. The south-west corner "
        "of a bed of a size is its (0, 0)");
    v.number("z_m", c.z_m, any_position_m, "mean height of the bed at x = 0, y = 0 of the mission");
    v.number("slope_deg", c.slope_deg, between(0, 60), "slope of the whole bed");
    v.number("uphill_deg", c.uphill_deg, any_angle_deg,
             "direction in which it rises, from x towards y");
    v.text("material", c.material, "material of the bed; default: scene.material_default");
    v.text("class", c.class_name, "class of the bed, for labels");
    v.optional_section("roughness", c.roughness, "random heights of all wavelengths");
    v.optional_section("ripples", c.ripples, "sand ripples");
    v.optional_section("waves", c.waves, "sand waves: a second train of ripples, of other sizes");
}

}  // namespace sonarsim
