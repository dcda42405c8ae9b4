#include "checks/warning.h"

#include <array>

namespace sonarsim {

namespace {

struct Row {
    Doubt doubt;
    WarningWords words;
};

constexpr std::array rows{
    Row{Doubt::reading, {"{0}", ""}},
    Row{Doubt::scene_huge,
        {"it is {0:.4g} x {1:.4g} x {2:.4g} m",
         "if the file is in millimetres or centimetres, "
         "write scene.units: mm or cm"}},
    Row{Doubt::scene_tiny,
        {"it is {0:.3g} x {1:.3g} x {2:.3g} m, and the sonars reach {3:.4g} m",
         "if the file is in kilometres or inches, write scene.units: km or in"}},
    Row{Doubt::scene_out_of_scale,
        {"it is {0:.4g} m long, {1:.3g} times the sonars' way and range, and {2} of {3} pings see "
         "nothing of it",
         "check its units (scene.units) and the trajectory's coordinates"}},
    Row{Doubt::scene_on_edge,
        {"{0:.0f} % of its surface stands upright along x and {1:.0f} % lies flat, like a sea "
         "floor on its edge",
         "if z points up in the file, write scene.up: z; if y does, leave scene.up out"}},
    Row{Doubt::water_density,
        {"water.density_kg_m3 is {0:.6g}; water has 950 to 1,200",
         "write it in kg/m^3: 1.025 g/cm^3 is 1025"}},
    Row{Doubt::water_speed,
        {"water.sound_speed_m_s is {0:.6g}; water has 1,350 to 1,700",
         "write it in m/s: 1.48 km/s is 1480"}},
    Row{Doubt::material_units,
        {"its {0} of {1:.6g} is beyond that of any solid",
         "write densities in kg/m^3 and speeds in m/s"}},
    Row{Doubt::material_silent,
        {"it ({0:.6g} kg/m^3, {1:.6g} m/s) reflects {2:.2g} of the power in this water "
         "({3:.6g} kg/m^3, {4:.6g} m/s): its impedance is that of the water",
         "check the materials' CSV and the water block"}},
    Row{Doubt::below_surface,
        {"in {0} of {1} pings there is surface above it and none below",
         "raise the trajectory: z points up, and depths are negative"}},
    Row{Doubt::inside_object,
        {"in {0} of {1} pings it is inside of '{2}'", "move the trajectory or the object"}},
    Row{Doubt::blind,
        {"{0} of {1} pings are blind: they see no surface within the range",
         "see what is said of them below; the trajectory may leave the scene"}},
    Row{Doubt::range_too_short,
        {"in {0} of {1} pings its range ends too early: what is in view begins at {2:.4g} to "
         "{3:.4g} m, and range_max_m is {4:.4g}",
         "raise range_max_m or sail nearer"}},
    Row{Doubt::range_begins_late,
        {"in {0} of {1} pings all that is in view ends by {2:.4g} m, and range_min_m is {3:.4g}",
         "lower range_min_m"}},
    Row{Doubt::elevation_too_narrow,
        {"in {0} of {1} pings there is surface within the range above or below its view alone, the "
         "nearest at elevations of {2:.0f} to {3:.0f} degrees, and {4} is {5:.4g}",
         "raise {4}, or tilt the sonar with mount.rpy_deg"}},
    Row{Doubt::looks_elsewhere,
        {"in {0} of {1} pings there is surface within the range, but nowhere near its view",
         "turn it with mount.rpy_deg or check the trajectory's attitudes"}},
    Row{Doubt::nothing_near,
        {"in {0} of {1} pings there is no surface within the range in any direction; {2}",
         "check the coordinates of the trajectory against the bounds of the scene"}},
    Row{Doubt::below_noise,
        {"its echoes drown in its noise: they are {0:.3g} in the mean of the lit bins, and the "
         "noise "
         "deviates by {1:.3g}",
         "lower noise.add_sigma, or with the calibrated model the receiver's noise"}},
    Row{Doubt::saturated,
        {"{0:.1f} % of its lit bins are above output.full_scale ({1:.4g}) and white in pictures; "
         "the brightest is {2:.3g}",
         "raise output.full_scale, or write auto"}},
    Row{Doubt::dim,
        {"its brightest pixel is {0:.3g}, which is grey level {1:.0f} of 255 in fans",
         "lower output.full_scale ({2:.4g}), or write auto"}},
    Row{Doubt::unseen_object, {"{0} by any of the pings that were tried: {1}", "{2}"}},
    Row{Doubt::radians,
        {"its attitudes are all within {0:.4g} degrees and look like radians ({1})",
         "write roll_deg, pitch_deg and yaw_deg in degrees"}},
    Row{Doubt::quaternion_order,
        {"in {0} of {1} poses the vehicle lies on its side or back; read as w x y z it would be "
         "upright in {2}",
         "write quaternions as qx qy qz qw"}},
    Row{Doubt::engine, {"{0}", ""}},
    Row{Doubt::doubled_triangles,
        {"node '{0}' and node '{1}' share {2} triangles; {3} of its {4} stand in two nodes: which "
         "of "
         "the two is seen there, and labelled, cannot be told",
         "take them out of one of the two"}},
    Row{Doubt::memory,
        {"a ping takes about {0:.2g} GB of memory, {1} at once {2:.2g} GB, and there are {3:.2g} "
         "GB",
         "lower {4}; with fewer threads (render -j) it takes less"}},
};

}  // namespace

WarningWords words_of(Doubt doubt) {
    for (const Row& row : rows) {
        if (row.doubt == doubt) return row.words;
    }
    return {"", ""};
}

std::string number_of(Doubt doubt) {
    return fmt::format("W{:02}", static_cast<int>(doubt));
}

std::string sentence(const Warning& warning) {
    return number_of(warning.doubt) + " " + warning.about + ": " + warning.what +
           (warning.cure.empty() ? "" : "; " + warning.cure);
}

std::string about_sensor(std::string_view name) {
    return "sensor '" + std::string(name) + "'";
}

}  // namespace sonarsim
