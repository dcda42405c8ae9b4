#include "run/checks/warning.h"

#include <iterator>

namespace sonarsim {

namespace {

// A figure that is a text has the format {:s}.
constexpr WarningText table[] = {
    {WarningCode::reading, "{0:s}", "",
     "parts that reading the scene drops, such as points, lines and vertices that are NaN, and "
     "values of a CSV in g/cm^3 or km/s"},
    {WarningCode::scene_out_of_scale,
     "it is {0:.4g} x {1:.4g} x {2:.4g} m; the sonars reach {3:.4g} m, and the trajectory extends "
     "over {4:.4g} m",
     "check its units (scene.units: mm, cm, km, in) and the coordinates of the trajectory; "
     "range_max_m is in metres",
     "a scene above 10 km, below 0.1 m or below 1 % of the longest range; or more than 20 times "
     "the extent of the trajectory plus twice the range, if half of the pings are blind"},
    {WarningCode::material_silent,
     "it ({0:.6g} kg/m^3, {1:.6g} m/s) reflects {2:.2g} of the power in this water ({3:.6g} "
     "kg/m^3, {4:.6g} m/s): its impedance is that of the water",
     "check the materials' CSV and the water block",
     "less than 1/65535 of the power reflected, one grey level of a 16-bit image"},
    {WarningCode::below_surface, "in {0} of {1} pings there is surface above it and none below",
     "raise the trajectory: z points up, and depths are negative; a heightmap of depths needs "
     "height_scale: -1",
     "surface in more than half of the directions above and in at most 2 % of those below, in more "
     "than half of the pings, if a tenth more of the scene's surface faces up than down"},
    {WarningCode::inside_object, "in {0} of {1} pings it is inside '{2:s}'",
     "move the trajectory or the object",
     "one instance in 98 % of all directions, unless it is as large as the scene and its faces "
     "look inwards, like those of a basin"},
    {WarningCode::blind, "{0} of {1} pings are blind: they see no surface within the range",
     "sonarsim validate prints the reason as W13 to W17; the trajectory may leave the scene",
     "one blind ping"},
    {WarningCode::range_too_short,
     "in {0} of {1} pings its range ends too early: the surface in view begins at {2:.4g} to "
     "{3:.4g} m, and range_max_m is {4:.4g}",
     "raise range_max_m or sail nearer{5:s}", "one blind ping"},
    {WarningCode::range_begins_late,
     "in {0} of {1} pings all surface in view ends by {2:.4g} m, and range_min_m is {3:.4g}",
     "lower range_min_m", "one blind ping"},
    {WarningCode::elevation_too_narrow,
     "in {0} of {1} pings the surface within the range lies only outside its view, the nearest at "
     "{6:s} of {2:.0f} to {3:.0f} degrees, and {4:s} is {5:.4g}",
     "raise {4:s}, or tilt the sonar with mount.rpy_deg (a positive pitch looks down)",
     "one blind ping"},
    {WarningCode::looks_elsewhere,
     "in {0} of {1} pings there is surface within the range, but nowhere near its view",
     "turn it with mount.rpy_deg or check the trajectory's attitudes; both are in degrees",
     "one blind ping"},
    {WarningCode::nothing_near,
     "in {0} of {1} pings there is no surface within the range in any direction; {2:s}",
     "check the coordinates of the trajectory against the bounds of the scene{3:s}",
     "one blind ping"},
    {WarningCode::below_noise,
     "its echoes are lost in its noise: their mean over the occupied bins is {0:.3g}, and the "
     "standard deviation of the noise is {1:.3g}",
     "lower the noise or raise the source: {2:s}",
     "a mean echo below a quarter of the noise's deviation"},
    {WarningCode::saturated,
     "{0:.1f} % of its occupied bins are above output.full_scale ({1:.4g}) and white in pictures; "
     "the brightest is {2:.3g}",
     "raise output.full_scale", "more than 5 % of the occupied bins"},
    {WarningCode::dim, "its brightest pixel is {0:.3g}, which is grey level {1:.0f} of 255 in fans",
     "lower output.full_scale ({2:.4g})", "the brightest pixel below grey level 16 of 255"},
    {WarningCode::hidden_object, "{0:s} by any of the pings that were tried: {1:s}", "{2:s}",
     "an object with a name or a class that none of four pings of each sonar sees, or below 5 mm; "
     "the tested pings look at it most directly, and the first 200 objects are tested, without a "
     "bed's rocks"},
    {WarningCode::memory,
     "a ping takes about {0:.2g} GB of memory, {1} at once {2:.2g} GB, and there are {3:.2g} GB",
     "lower {4:s}; with fewer threads (render -j) it takes less",
     "one ping on each thread takes more than the memory of the machine, the control group or the "
     "process, estimated with 4 samples a bin"},
    {WarningCode::no_locks,
     "the disk of this folder has no locks, so that a second run into it would not be refused and "
     "would mix its files with these",
     "start only one", "the file system refuses flock"},
    {WarningCode::goal_missed,
     "its images are off by {0:s} % on average over the pings that were measured, and by {1:s} % "
     "at pose {2}; accuracy.relative_l1 asks for {3:s} %",
     "{4:s}", "the error of one measured ping above the goal"},
    {WarningCode::heightmap_facets,
     "its cells of {0:.3g} m are {2:.0f} times as long as the range bins of {1:.3g} m, so that "
     "images show its flat facets",
     "cell_m: {3:.3g} interpolates it smoothly; or take fewer range bins",
     "cells above eight range bins of a sonar"},
    {WarningCode::azimuth_in_radians,
     "its azimuth_deg is {0:.4g}, and {0:.4g} radians are {1:.4g} degrees",
     "radians? azimuth_deg: {1:.4g}",
     "0.3 to 2 pi degrees for a kind of sonar whose default is wider"},
    {WarningCode::ping_too_early,
     "{0} of its {1} pings after the first begin before the sound of the ping before is back: it "
     "pings at up to {2:.4g} Hz, and the way to range_max_m ({3:.4g} m) and back allows {4:.4g} Hz",
     "lower the trajectory's rate_hz, raise every to {5:.0f}, or lower range_max_m",
     "one such ping, except with trajectory.look_at"},
    {WarningCode::scene_ends,
     "in {0} of {1} pings the scene ends within its view: directions within range_max_m pass "
     "beside the bottom",
     "take a larger bottom, or scene.seabed, which has no end",
     "a tenth of the pings, if the scene's surface faces up: a direction in view meets nothing and "
     "yet ends below the whole scene"},
};

static_assert(std::ranges::is_sorted(table, {}, &WarningText::code));

/// A format string as text for people: "N" in place of a number, "..." in place of a text.
std::string without_figures(std::string_view format) {
    std::string out;
    while (!format.empty()) {
        const std::size_t end = format.front() == '{' ? format.find('}') : std::string_view::npos;
        if (end == std::string_view::npos) {
            out += format.front();
            format.remove_prefix(1);
        } else {
            out += format[end - 1] == 's' ? "..." : "N";
            format.remove_prefix(end + 1);
        }
    }
    return out;
}

}  // namespace

std::span<const WarningText> warning_table() {
    return table;
}

std::string warning_table_markdown() {
    std::string text = "| | what is found | what helps | limit |\n|---|---|---|---|\n";
    for (const WarningText& row : warning_table()) {
        text += fmt::format("| {} | {} | {} | {} |\n", number_of(row.code),
                            without_figures(row.what), without_figures(row.cure), row.limit);
    }
    return text;
}

void append(std::vector<Warning>& out, std::vector<Warning> more) {
    std::ranges::move(more, std::back_inserter(out));
}

std::string number_of(WarningCode code) {
    return fmt::format("W{:02}", static_cast<int>(code));
}

std::string sentence(const Warning& warning) {
    return number_of(warning.code) + " " + warning.about + ": " + warning.what +
           (warning.cure.empty() ? "" : "; " + warning.cure);
}

std::string about_sensor(std::string_view name) {
    return "sensor '" + std::string(name) + "'";
}

}  // namespace sonarsim
