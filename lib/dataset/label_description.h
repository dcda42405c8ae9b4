#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "assembly/assemble.h"
#include "dataset/checked_json.h"
#include "mission/label_config.h"

namespace sonarsim {

/// World boxes around the objects; empty for an object without triangles, and if a part of it
/// moves.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// An object that moves as a whole.
struct MovingObject {
    std::size_t body = 0;     ///< index into Scene::bodies
    Eigen::AlignedBox3d box;  ///< box around it in its own frame
};
/// One for each object; nothing for an object that stands still or consists of several parts.
std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly);

/// The names of the ids of labels for dataset.json, with the world boxes (m) of instances; null as
/// in object_boxes().
nlohmann::ordered_json describe_label_ids(const Assembly& assembly);

/// The rules of a dataset's annotations.
struct AnnotationRules {
    LabelConfig config{
        .min_pixels = 1, .min_visible_share = 0.0, .min_contrast_db = 0.0, .place = {}};
    std::vector<std::uint8_t> background{};  ///< indexed by class: 1 if it is never annotated

    /// True for the index of a class that is never annotated.
    bool is_background(std::size_t class_index) const {
        return class_index < background.size() && background[class_index] != 0;
    }
};

/// `labels.annotations` of dataset.json.
nlohmann::ordered_json describe_annotations(const LabelConfig& config, const SceneObjects& objects);
/// Reads this back from `labels`; datasets of older versions annotate all objects. InputError for a
/// wrong value.
AnnotationRules annotation_rules(const CheckedJson& labels);

}  // namespace sonarsim
