#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// Keys of a section, or values of a key, that missions had once.
struct RemovedKey {
    std::string_view sections;  ///< names of the sections, or of the key; blanks separate them
    std::string_view names;     ///< the keys, or the values
    std::string_view instead;   ///< the way to do it now
};

inline constexpr RemovedKey removed_keys[] = {
    {"speckle", "clutter_shape clutter_m relief", "write texture, a factor on the texture of surface"},
    {"receiver", "looks", "write samples and combine: mean"},
    {"octree", "literal", "leave it out: the octree is always the paper's"},
    {"octree", "memory_mb", "leave it out: the octree takes up to 512 MB for what is out of view"},
    {"labels", "min_pixels", "give it to the export: sonarsim export --min-pixels"},
    {"labels", "min_visible_share", "give it to the export: sonarsim export --min-visible-share"},
    {"labels", "min_contrast_db", "give it to the export: sonarsim export --min-contrast-db"},
    {"labels", "faint", "give it to the export: sonarsim export --faint"},
    {"labels", "box", "give it to the export: sonarsim export --box"},
    {"output", "split", "give the shares to the export: sonarsim export --split"},
    {"output", "pack pack_size_mb", "write files, then run sonarsim export --format webdataset"},
    {"output", "fan_style",
     "fans are grey; colour them where they are shown, or use sonarsim preview"},
    {"output", "meta", "leave it out: a JSON file is written for every ping"},
    {"output", "fan_width_px", "leave it out: a fan has one pixel per range bin, at most 1024"},
    {"output", "waterfall", "leave it out: the waterfall of a side-scan sonar is always written"},
    {"output", "echogram", "leave it out: the echogram of an echosounder is always written"},
    {"output", "soundings", "leave it out: the soundings of a profiling sonar are always written"},
    {"output", "scan", "leave it out: the scans of a scanning sonar are always written"},
    {"output", "bathymetry_cell_m", "leave it out: a cell has four soundings or more on average"},
    {"output", "mosaic_cell_m", "leave it out: a cell is as large as the distance between pings"},
    {"polar", "exr tiff", "write polar: true, which gives .npy files"},
    {"fan", "jpeg webp", "write fan: true, which gives PNG files"},
    {"labels", "coco", "write labels: [objects], then run sonarsim export --format coco"},
    {"labels", "yolo", "write labels: [objects], then run sonarsim export --format yolo"},
    {"labels", "yolo_polygons",
     "write labels: [objects], then run sonarsim export --format yolo --polygons"},
    {"seabed", "waves", "put their heights into scene.heightmap"},
    {"seabed", "pockmarks scars", "put them into a mesh or into scene.heightmap"},
    {"seabed", "plants", "place them as objects: scene.scatter"},
    {"heightmap", "keep", "all heights are kept; make the map coarser with gdal_translate -tr"},
    {"sediment_map backscatter_map", "placed", "maps lie on the ground from above; leave it out"},
    {"objects scatter", "buried", "objects wholly below the bottom have no echo; leave it out"},
    {"particles", "buried", "points below the bottom have no echo; leave it out"},
    {"pulse", "floor_db", "side_lobe_db sets the side lobes of the pulse; leave it out"},
    {"pulse", "sweep", "motion shifts no echo in range; leave it out"},
    {"beam", "azimuths_deg", "write spread: angle or spread: sine"},
    {"speckle", "per_cell", "four scatterers make a resolution cell; leave it out"},
    {"receiver", "tvg_step_db", "the TVG grows smoothly; leave it out"},
    {"receiver", "blanking_m", "write range_min_m, or set these rows to 0 where they are used"},
    {"receiver", "sector_gain_db sectors",
     "beam_gain_db sets the gains of single beams; leave it out"},
    {"receiver", "gain_drift_db gain_drift_pings",
     "scale the images of a dataset where they are used"},
    {"receiver", "dropped_share", "leave out pings of a dataset where they are used"},
    {"receiver", "spikes_per_ping spike_db", "add spikes to the images where they are used"},
    {"receiver", "interference", "add it to the images where they are used"},
    {"multipath", "columns_per_beam", "accuracy.relative_l1 sets the samples; leave it out"},
    {"multipath", "retraced retraced_loss_db", "echoes end at the second surface; leave it out"},
    {"water", "drift_rms_m_s current_m_s", "the water has new speckle in each ping; leave it out"},
    {"water", "ph", "leave it out: the acidity of the water is 8"},
    {"water", "suspended_mg_l suspended_um", "write water.content or water.scattering_db_per_m3"},
    {"profile", "points", "write them into a CSV, and give its path as 'file'"},
    {"scatter", "tries", "leave it out: 1,000 places are tried for each object"},
    {"particles", "law",
     "fish follow Love's law; for another, give kind: points a target_strength_db"},
    {"particles", "per_m3", "write count: this density times the volume of the region"},
    {"particles", "instances", "leave it out: groups of 100 targets or more are one object"},
    {"water", "assumed_profile", "soundings use water.profile; leave it out"},
    {"mission", "slices", "leave it out: the number of slices follows from accuracy.relative_l1"},
    {"motion", "lag_s", "leave it out: the vehicle follows the waves at once"},
    {"navigation", "heading_bias_deg heading_drift_deg_h",
     "write heading_deg, an error of each pose"},
    {"navigation", "speed_scale", "write position_m, an error of each pose"},
    {"instrument", "power_w", "write instrument.source_level_db"},
    {"receiver", "efficiency", "write instrument.source_level_db and receiver.noise_db"},
    {"receiver", "noise_figure_db", "write receiver.noise_db"},
    {"scene objects scatter", "exclude", "delete these nodes in the file"},
    {"scene", "repeats", "leave it out: many copies are shared where rays trace the scene"},
    {"sediment_map backscatter_map", "instances",
     "maps lie on the ground; name its nodes in scene.bottom"},
    {"heightmap sediment_map backscatter_map", "no_data",
     "write it into the file: gdal_translate -a_nodata VALUE"},
    {"seabed", "slope_deg uphill_deg", "put the heights into scene.heightmap"},
    {"seabed", "border_m", "leave it out: bays have a tenth of patch_m"},
    {"seabed", "origin_m", "move the trajectory and the objects instead"},
    {"ripples", "share patch_m", "leave it out: ripples cover the whole bed"},
    {"ripples", "spread", "leave it out: it is 0.05"},
    {"labels", "semantic", "write labels: [class], whose files hold the same ids"},
    {"scene objects scatter", "materials_map", "name the file's materials in the CSV"},
    {"heightmap sediment_map backscatter_map", "size_m", "write pixel_m, the size of a pixel"},
    {"backscatter_map", "scale_db offset_db",
     "write decibels into the file: gdal_translate -ot Float32 -scale"},
    {"rocks", "class", "rocks have the class rock; write a rule of `classes` for the nodes rock_*"},
};

/// True if `word` is one of `words`, which blanks separate.
inline bool has_word(std::string_view words, std::string_view word) {
    return (" " + std::string(words) + " ").find(" " + std::string(word) + " ") !=
           std::string::npos;
}

/// The message for a removed key or value; empty for others.
inline std::string instead_of_removed(std::string_view section, std::string_view name) {
    for (const RemovedKey& one : removed_keys) {
        if (has_word(one.sections, section) && has_word(one.names, name))
            return "'" + std::string(name) + "' is no longer there; " + std::string(one.instead);
    }
    return {};
}

}  // namespace sonarsim
