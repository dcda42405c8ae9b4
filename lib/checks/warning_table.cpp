#include <algorithm>
#include <array>

#include "checks/warning.h"

namespace sonarsim {

namespace {

// A figure that is a text has the format {:s}.
constexpr std::array table{
    WarningText{
        WarningCode::reading, "{0:s}", "", "parts that reading the scene drops, and odd values",
        "points and lines, vertices that floats round, a CSV in g/cm^3 or km/s, a z that an "
        "object on the bottom does not use, a water.depth_m far from the vehicle's"},
    WarningText{WarningCode::scene_huge, "it is {0:.4g} x {1:.4g} x {2:.4g} m",
                "if the file is in millimetres or centimetres, write scene.units: mm or cm",
                "a scene above 10 km",
                "no sonar here reaches a kilometre, and a survey of 10 km takes hours; tens of "
                "metres that are written in millimetres are tens of kilometres"},
    WarningText{WarningCode::scene_tiny,
                "it is {0:.3g} x {1:.3g} x {2:.3g} m, and the sonars reach {3:.4g} m",
                "if the file is in kilometres or inches, write scene.units: km or in; else lower "
                "sensors.NAME.range_max_m, which is in metres",
                "below 0.1 m, or 1 % of the longest range",
                "the smallest laboratory tank is larger; 1 % of the range is five of 512 bins"},
    WarningText{WarningCode::scene_out_of_scale,
                "it is {0:.4g} m long, {1:.3g} times the extent of the trajectory plus twice the "
                "range, and {2} of {3} pings see nothing of it",
                "check its units (scene.units) and the trajectory's coordinates",
                "more than 20 times the extent of the trajectory plus twice the range, and half of "
                "the pings blind",
                "all pings together see less than a 20th of its length; a short survey of a large "
                "harbour does so too, but is not blind"},
    WarningText{
        WarningCode::scene_on_edge,
        "{0:.0f} % of its surface stands upright along x and {1:.0f} % lies flat, like a sea floor "
        "on its edge",
        "if z points up in the file, write scene.up: z; if y does, leave scene.up out",
        "half of the surface faces along the world's y, at most 10 % faces up or down, and the "
        "scene is less than half as thick along y as along the others",
        "a sea floor with z up that is read as y up faces along y with nearly all of its surface; "
        "a part of a quay or a hull faces up, and a tank has walls along both axes"},
    WarningText{WarningCode::water_density,
                "water.density_kg_m3 is {0:.6g}; water has 950 to 1,200",
                "write it in kg/m^3: 1.025 g/cm^3 is 1025", "outside 950 to 1,200 kg/m^3",
                "boiling fresh water has 958, the brine of deep pools 1,200"},
    WarningText{WarningCode::water_speed,
                "water.sound_speed_m_s is {0:.6g}; water has 1,350 to 1,700",
                "write it in m/s: 1.48 km/s is 1480", "outside 1,350 to 1,700 m/s",
                "freezing fresh water has 1,402; the pressure of the deepest sea does not raise it "
                "to 1,650"},
    WarningText{WarningCode::material_units, "its {0:s} of {1:.6g} is beyond that of any solid",
                "write densities in kg/m^3 and speeds in m/s", "above 25,000 kg/m^3 or 20,000 m/s",
                "osmium has 22,600 kg/m^3, diamond 18,000 m/s"},
    WarningText{WarningCode::material_silent,
                "it ({0:.6g} kg/m^3, {1:.6g} m/s) reflects {2:.2g} of the power in this water "
                "({3:.6g} kg/m^3, {4:.6g} m/s): its impedance is that of the water",
                "check the materials' CSV and the water block",
                "less than 1/65535 of the power reflected",
                "one grey level of a 16-bit image in which a perfect mirror is white; the "
                "impedances agree to 0.8 %"},
    WarningText{
        WarningCode::below_surface, "in {0} of {1} pings there is surface above it and none below",
        "raise the trajectory: z points up, and depths are negative",
        "surface in more than half of the directions above and in at most 2 % of those below, in "
        "more than half of the pings, if the scene lies open upwards",
        "below a sea floor surface is everywhere above and nowhere below; under a hull or a jetty "
        "there is a floor below; 2 % are gaps in a mesh. A scene lies open upwards if a tenth more "
        "of its surface faces up than down; they are equal for a closed body"},
    WarningText{WarningCode::inside_object, "in {0} of {1} pings it is inside of '{2:s}'",
                "move the trajectory or the object", "one instance in 98 % of all directions",
                "a wall, however near, fills half of the directions; 2 % are gaps in a mesh. An "
                "instance with nine tenths of the scene's extent on every axis is a basin, and the "
                "sonar is meant to be in it"},
    WarningText{
        WarningCode::blind, "{0} of {1} pings are blind: they see no surface within the range",
        "sonarsim validate prints the reason as W13 to W17; the trajectory may leave the scene",
        "one blind ping", "it takes as long as the others and shows nothing"},
    WarningText{WarningCode::range_too_short,
                "in {0} of {1} pings its range ends too early: the surface in view begins at "
                "{2:.4g} to {3:.4g} m, and range_max_m is {4:.4g}",
                "raise range_max_m or sail nearer{5:s}", "one blind ping", "as W12"},
    WarningText{
        WarningCode::range_begins_late,
        "in {0} of {1} pings all surface in view ends by {2:.4g} m, and range_min_m is {3:.4g}",
        "lower range_min_m", "one blind ping", "as W12"},
    WarningText{
        WarningCode::elevation_too_narrow,
        "in {0} of {1} pings the surface within the range lies only above or below its view, the "
        "nearest at elevations of {2:.0f} to {3:.0f} degrees, and {4:s} is {5:.4g}",
        "raise {4:s}, or tilt the sonar with mount.rpy_deg", "one blind ping", "as W12"},
    WarningText{WarningCode::looks_elsewhere,
                "in {0} of {1} pings there is surface within the range, but nowhere near its view",
                "turn it with mount.rpy_deg or check the trajectory's attitudes", "one blind ping",
                "as W12"},
    WarningText{WarningCode::nothing_near,
                "in {0} of {1} pings there is no surface within the range in any direction; {2:s}",
                "check the coordinates of the trajectory against the bounds of the scene{3:s}",
                "one blind ping", "as W12"},
    WarningText{
        WarningCode::below_noise,
        "its echoes are lost in its noise: their mean over the occupied bins is {0:.3g}, and "
        "the standard deviation of the noise is {1:.3g}",
        "lower the noise or raise the source: {2:s}",
        "a mean echo below a quarter of the noise's deviation",
        "the mean of 16 bins is then at most one deviation above zero"},
    WarningText{WarningCode::saturated,
                "{0:.1f} % of its occupied bins are above output.full_scale ({1:.4g}) and white in "
                "pictures; the brightest is {2:.3g}",
                "raise output.full_scale, or write auto", "more than 5 % of the occupied bins",
                "auto leaves 1 % white"},
    WarningText{WarningCode::dim,
                "its brightest pixel is {0:.3g}, which is grey level {1:.0f} of 255 in fans",
                "lower output.full_scale ({2:.4g}), or write auto",
                "the brightest pixel below grey level 16 of 255",
                "ordinary screens show such pixels as black"},
    WarningText{WarningCode::unseen_object, "{0:s} by any of the pings that were tried: {1:s}",
                "{2:s}",
                "an object with a name or a class that none of four pings of each sonar sees; the "
                "tested pings look at it most directly",
                "each try takes a ping, and few objects are visible only from the side; the first "
                "200 objects are tested"},
    WarningText{WarningCode::radians, "{0:s} look like radians ({1:s})", "write angles in degrees",
                "headings more than 30 degrees off the track, and within 15 if read as radians; or "
                "the largest angle a multiple of pi / 2 to 0.1 %; or an angle of a sonar or an "
                "object that is one, or has three decimals and is a multiple of 5 degrees to "
                "0.05 % if read as radians",
                "a vehicle that crabs in a current is rarely 30 degrees off; an angle of 1.571 "
                "degrees is rarer still, and nobody mounts a sonar at 0.5236 degrees"},
    WarningText{WarningCode::quaternion_order,
                "in {0} of {1} poses the vehicle lies on its side or back; read as w x y z it "
                "would be upright in {2}",
                "write quaternions as qx qy qz qw",
                "more than half of the poses lie on the side or the back, and nine of ten are "
                "upright in the other order of the quaternion",
                "a vehicle that rolls over is not upright in the other order"},
    WarningText{WarningCode::engine, "{0:s}", "",
                "an engine that misses accuracy.relative_l1 in this view, or that lacks memory",
                "the engine derives or measures its error; it knows its memory"},
    WarningText{WarningCode::doubled_triangles,
                "node '{0:s}' and node '{1:s}' share {2} triangles; {3} of its {4} stand in two "
                "nodes: it is arbitrary which of the two is visible and labelled",
                "take them out of one of the two",
                "more than 1 % of the scene's triangles have exactly the same corners in two nodes",
                "two bodies that touch may share a few, a part that was written twice shares all. "
                "Copies of one mesh and what moves are not compared"},
    WarningText{
        WarningCode::memory,
        "a ping takes about {0:.2g} GB of memory, {1} at once {2:.2g} GB, and there are {3:.2g} GB",
        "lower {4:s}; with fewer threads (render -j) it takes less",
        "one ping on each thread takes more than the memory of the machine, the control group or "
        "the process",
        "the memory of a ping is estimated with 4 samples a bin, as with surface in all of them. "
        "If not even one ping has room, validate makes none to measure its time"},
    WarningText{WarningCode::no_locks,
                "the disk of this folder has no locks, so that a second run into it would not be "
                "refused and would mix its files with these",
                "start only one", "the file system refuses flock",
                "nothing else keeps two runs apart"},
    WarningText{
        WarningCode::goal_missed,
        "its images are off by {0:.2g} % on average over the pings that were measured, and by "
        "{1:.2g} % at pose {2}; accuracy.relative_l1 asks for {3:.4g} %",
        "{4:s}", "the error of one measured ping, less the reference's own noise, above the goal",
        "three pings of each sonar are compared with the reference when a job begins"},
    WarningText{WarningCode::samples_dropped,
                "{0} of {1} pieces of surface were left out, since they are edge-on, at no "
                "distance or lost in rounding",
                "widen its beams or bins, which are too narrow for the scene", "half of them",
                "the image then shows little of the surface in view"},
    WarningText{
        WarningCode::noise_beyond_range,
        "{0:.1f} % of its echoes were dropped outside the range: noise.range_lambda_m shifts them "
        "by {1:.4g} m on average, and the range is {2:.4g} m long",
        "lower noise.range_lambda_m",
        "half of the echoes, if the mean shift is above a tenth of the range",
        "a shorter shift moves few echoes out of the range: those are lost for another reason"},
    WarningText{WarningCode::thin_fan,
                "its fans show next to nothing: azimuth_deg of {0:.4g} is {1:.2g} m wide at "
                "range_max_m, and a pixel {2:.2g} m",
                "look at the polar images, or raise output.fan_width_px",
                "the sector is thinner than a pixel at its far end",
                "most rows of the picture then have no pixel in the sector"},
    WarningText{
        WarningCode::disk_full,
        "the dataset takes about {0:.1f} GB, and its disk has {1:.1f} GB free",
        "render fewer pings or files (output), or write to another disk with --out",
        "validate estimates a greater size than the free space, and nothing is rendered yet",
        "the estimate is the mean of a few pings; a run that fills the disk stops, and "
        "goes on once there is room"},
    WarningText{
        WarningCode::multipath_missed,
        "{0} of {1} pings may miss more than 5 % of the bins with multipath, or fill others by "
        "mistake, the worst an estimated {2:.2g} %: facets are too small for the rays, or their "
        "echoes thinner than a bin",
        "raise multipath.columns_per_beam (2 cost two to three times the time, 4 about eight "
        "times), or lower accuracy.relative_l1",
        "one ping of a fan whose estimate is above 5 % of the bins with multipath",
        "accuracy.relative_l1 holds for direct echoes: a facet that is narrower than a column of "
        "rays hardly counts for them, but its echo over a second surface may have bins of its "
        "own. The standard error of a few bins is large, and the estimate includes twice that"},
    WarningText{WarningCode::unseen_particles,
                "no tested ping sees a target of these groups of scene.particles: {0:s}",
                "move them into the view of a sonar, raise their count, or leave them out",
                "a group without a target in view and in front of the surface in up to 200 pings "
                "of each sonar",
                "they cost time in each ping and have no label"},
    WarningText{
        WarningCode::heightmap_facets,
        "its cells of {0:.3g} m are {2:.0f} times as long as the range bins of {1:.3g} m, "
        "so that images show its flat facets",
        "interpolate the map smoothly onto smaller cells before, as by gdalwarp -tr {1:.3g} "
        "{1:.3g} -r cubicspline, or take fewer range bins",
        "cells above eight range bins of a sonar",
        "the shade of a facet is constant, and its borders are seen where it fills many bins"},
};

static_assert(std::ranges::is_sorted(table, {}, &WarningText::code));

}  // namespace

std::span<const WarningText> warning_table() {
    return table;
}

}  // namespace sonarsim
