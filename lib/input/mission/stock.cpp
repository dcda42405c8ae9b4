#include "input/mission/stock.h"

#include <cmath>
#include <utility>

#include "core/text.h"
#include "input/mission/preset.h"
#include "input/mission/value_types.h"

namespace sonarsim {

namespace {

constexpr const char* stock_kinds[]{"anchor",       "block",        "bottle",
                                    "boulder_pile", "brick",        "bucket",
                                    "buoy",         "cable",        "can",
                                    "carton",       "chain",        "coral_head",
                                    "crate",        "drag_mark",    "drum",
                                    "frame",        "gas_cylinder", "ghost_gear",
                                    "hook",         "ladder",       "line_valve",
                                    "mine",         "net",          "pallet",
                                    "panel",        "person",       "pipe",
                                    "plank",        "plant",        "plastic_bottle",
                                    "propeller",    "rope",         "shampoo_bottle",
                                    "starfish",     "stone",        "tarpaulin",
                                    "torpedo",      "trap",         "tyre",
                                    "valve",        "weed",         "wheel",
                                    "wreckage"};

/// The kinds of clutter by default, as CLUTTER of scripts/scenes/stock.
constexpr const char* clutter_kinds[]{
    "boulder_pile", "brick", "cable", "chain", "drag_mark", "frame",     "net",  "panel",
    "pipe",         "plank", "plant", "rope",  "stone",     "tarpaulin", "weed", "wreckage"};

/// The number of drawn examples of a kind.
constexpr int stock_examples = 6;

/// Adds an empty list to a section.
YamlNode& add_list(YamlNode& section, const char* key, const YamlPlace& place) {
    YamlNode& list = section.items.emplace_back();
    list.kind = YamlNode::Kind::list;
    list.key = key;
    set_place(list, place);
    return list;
}

/// The files of a kind of the stock, absolute. `missing`: a file was not there, one error for all.
void add_files(const YamlNode& kind, const std::filesystem::path& base_folder, ErrorList& errors,
               bool& missing, std::vector<YamlNode>& files) {
    const std::vector<std::string> kinds(std::begin(stock_kinds), std::end(stock_kinds));
    const bool is_known = errors.attempt([&] {
        if (contains(kinds, kind.text)) return;
        refuse(kind.place, "the stock has no {}{}; there are: {}", in_quotes(kind.text),
               did_you_mean(kind.text, kinds), listed(kinds));
    });
    for (int k = 1; k <= stock_examples; ++k) {
        const std::string name = kind.text + "_" + std::to_string(k) + ".glb";
        const std::filesystem::path path =
            preset_file("../scenes/generated/stock/" + name, base_folder);
        errors.attempt([&] {
            if (!path.empty() || !is_known || std::exchange(missing, true)) return;
            refuse(kind.place,
                   "the stock's file {} has not been made; scripts/make_scenes.py stock makes it, "
                   "as scripts/render.sh does with a mission",
                   name);
        });
        YamlNode& file = files.emplace_back(kind);
        file.text = path.empty() ? name : path.lexically_normal().string();
        file.quoted = true;
    }
}

/// The kinds of clutter by default: none that a rule of `scatter` labels as objects.
std::vector<std::string> unlabelled_kinds(const YamlNode* scatter) {
    std::vector<std::string> kinds(std::begin(clutter_kinds), std::end(clutter_kinds));
    if (scatter == nullptr) return kinds;
    for (const YamlNode& rule : scatter->items) {
        const YamlNode* const stock = rule.find("stock");
        const YamlNode* const name = rule.find("class");
        if (stock == nullptr || (name != nullptr && name->text == clutter_class)) continue;
        for (const YamlNode& kind : stock->items)
            std::erase(kinds, kind.text);
    }
    return kinds;
}

/// A rule of `scatter` with the keys of `clutter` and defaults for the others.
YamlNode rule_of_clutter(YamlNode clutter, const YamlNode* scatter) {
    if (clutter.kind != YamlNode::Kind::map)
        refuse_type(clutter, "clutter", "a section with the key density_per_m2");
    if (clutter.find("density_per_m2") == nullptr)
        refuse(clutter.place, "'clutter' needs the key 'density_per_m2'");
    const std::vector<std::string> kinds = unlabelled_kinds(scatter);
    if (kinds.empty() && clutter.find("stock") == nullptr)
        refuse(clutter.place, "'scatter' labels every kind of clutter; give 'clutter' its 'stock'");
    const ClutterConfig scales;
    YamlNode defaults = read_document(
        "{name: clutter, overlap: true, class: clutter, roll_deg: [-15, 15], "
        "pitch_deg: [-15, 15], scale: " +
            yaml_text(scales.scale) + ", bury: " + yaml_text(scales.bury) + ", stock: [" +
            listed(kinds) + "]}",
        "");
    set_place(defaults, clutter.place);
    add_missing(defaults, clutter);
    clutter.key.clear();
    return clutter;
}

/// Gives a rule without an area the default one; none for all of a mesh.
void set_area(const SceneConfig& scene, ScatterConfig& rule) {
    rule.area_min_m = scene.area_min_m;
    rule.area_max_m = scene.area_max_m;
    if (rule.area_min_m) return;
    if (scene.seabed && scene.seabed->size_m) {
        rule.area_min_m = {0.0, 0.0};
        rule.area_max_m = scene.seabed->size_m;
    } else if (scene.seabed || scene.heightmap || rule.density_per_m2[1] > 0.0) {
        refuse(rule.place,
               "'{}' needs an area: area_min_m and area_max_m, here or for all rules in 'scene'",
               printable(rule.name));
    }
}

}  // namespace

void fill_in_stock(YamlNode& mission, const std::filesystem::path& base_folder, ErrorList& errors) {
    YamlNode* const scene = child(&mission, "scene");
    if (const YamlNode* const clutter = child(scene, "clutter")) {
        YamlNode rule = rule_of_clutter(*clutter, scene->find("scatter"));
        erase_key(*scene, "clutter");
        if (scene->find("scatter") == nullptr) add_list(*scene, "scatter", rule.place);
        if (YamlNode* const rules = scene->find("scatter"); rules->kind == YamlNode::Kind::list)
            rules->items.push_back(std::move(rule));
    }
    YamlNode* const rules = child(scene, "scatter");
    if (rules == nullptr || rules->kind != YamlNode::Kind::list) return;
    bool missing = false;
    for (YamlNode& rule : rules->items) {
        const YamlNode* const stock = child(&rule, "stock");
        if (stock == nullptr || rule.find("files") != nullptr ||
            stock->kind != YamlNode::Kind::list || stock->items.empty())
            continue;  // the reader says what is wrong
        std::vector<YamlNode> files;
        for (const YamlNode& kind : stock->items)
            add_files(kind, base_folder, errors, missing, files);
        const YamlPlace place = stock->place;
        add_list(rule, "files", place).items = std::move(files);
    }
}

void complete_scatter(SceneConfig& scene) {
    for (ScatterConfig& rule : scene.scatter) {
        if (!rule.area_min_m) set_area(scene, rule);
        if (rule.density_per_m2[1] == 0.0) continue;
        rule.count = {std::floor(rule.density_per_m2[0] * rule.area_m2()),
                      std::ceil(rule.density_per_m2[1] * rule.area_m2())};
        if (rule.count[1] > 1e5) {
            refuse(rule.place,
                   "'{}' is more than 100,000 objects; lower density_per_m2 or take a smaller area",
                   printable(rule.name));
        }
    }
}

}  // namespace sonarsim
