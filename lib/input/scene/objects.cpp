#include "input/scene/objects.h"

#include <map>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_ids = 65535;  // 16 bits without 0

/// Numbers names in the order in which they occur.
struct NumberedNames {
    std::vector<std::string> names;
    std::map<std::string, std::uint32_t> numbers;

    std::uint32_t number(const std::string& name) {
        const auto [entry, is_new] =
            numbers.emplace(name, static_cast<std::uint32_t>(names.size()));
        if (is_new) names.push_back(name);
        return entry->second;
    }
};

using NamedInstances = std::vector<std::pair<std::string, std::string>>;

/// The rule that applies to each instance; null: none. InputError for a rule that applies to none.
std::vector<const ClassConfig*> rule_of_instances(const NamedInstances& instances,
                                                  std::span<const ClassConfig> rules) {
    std::vector<const ClassConfig*> chosen(instances.size(), nullptr);
    for (const ClassConfig& rule : rules) {
        const std::string pattern = rule.pattern();
        bool fits = false;
        bool taken = false;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            if (!fits_pattern(pattern, instances[i].first)) continue;
            taken = taken || chosen[i] != nullptr;
            fits = fits || chosen[i] == nullptr;
            if (!chosen[i]) chosen[i] = &rule;
        }
        if (fits) continue;
        const bool by_node = rule.materials.empty();
        refuse(rule.place, "no {} of the scene {} '{}'{}", by_node ? "node" : "material",
               taken ? "is left for" : "fits", by_node ? rule.nodes : rule.materials,
               taken ? ": rules above it take all that fit"
                     : "; `sonarsim inspect` lists the names of its nodes and materials");
    }
    return chosen;
}

/// The possible instances, followed by those of the scene.
NamedInstances all_instances(const Scene& scene, const PossibleObjects& possible) {
    NamedInstances all = possible.instances;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const bool known = i < scene.instance_classes.size();
        all.emplace_back(scene.instances[i], known ? scene.instance_classes[i] : std::string());
    }
    return all;
}

void require_ids(std::size_t count, const char* what) {
    if (count <= max_ids) return;
    throw InputError(fmt::format(
        "the scene has {} {}, and labels of 16 bits have at most 65535: group them with `classes`",
        count, what));
}

}  // namespace

bool fits_pattern(std::string_view pattern, std::string_view text) {
    std::size_t p = 0;
    std::size_t t = 0;
    std::size_t star = std::string_view::npos;  // last star, and the end of its text
    std::size_t resume = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool fits_any(std::span<const std::string> patterns, std::string_view text) {
    return std::ranges::any_of(
        patterns, [&](const std::string& pattern) { return fits_pattern(pattern, text); });
}

bool fits_instance(std::span<const std::string> patterns, const Scene& scene, std::size_t i) {
    return fits_any(patterns, scene.instances[i]) ||
           (i < scene.own_names.size() && fits_any(patterns, scene.own_names[i]));
}

SceneObjects group_objects(const Scene& scene, std::span<const ClassConfig> rules,
                           const PossibleObjects& possible) {
    const NamedInstances instances = all_instances(scene, possible);
    const std::vector<const ClassConfig*> rule_of = rule_of_instances(instances, rules);
    SceneObjects out;
    NumberedNames classes;
    NumberedNames names;
    for (const std::string& name : possible.classes)
        classes.number(name);
    std::vector<const ClassConfig*> maker;  // the rule that made each object
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const auto& [name, own] = instances[i];
        const ClassConfig* const rule = rule_of[i];
        const bool grouped = rule && !rule->instance.empty();
        const std::uint32_t class_index = classes.number(rule          ? rule->name
                                                         : own.empty() ? without_copy_number(name)
                                                                       : own);
        if (i < possible.instances.size()) continue;
        const std::uint32_t object = names.number(grouped ? rule->instance : name);
        out.object_of_instance.push_back(object);
        if (object == out.objects.size()) {
            out.objects.push_back({names.names[object], class_index});
            maker.push_back(grouped ? rule : nullptr);
            continue;
        }
        // Names of nodes are unique, so if two nodes share a name, a rule has grouped one of them.
        const ClassConfig& culprit = grouped ? *rule : *maker[object];
        if (!grouped || !maker[object]) {
            refuse(culprit.place,
                   "the instance '{}' has the name of a node that is not in it; choose another",
                   culprit.instance);
        }
        if (out.objects[object].class_index != class_index) {
            refuse(
                culprit.place,
                "the instance '{}' has the class '{}' here and '{}' in another rule; an instance "
                "has one class",
                culprit.instance, rule->name, classes.names[out.objects[object].class_index]);
        }
    }
    require_ids(out.objects.size(), "objects");
    require_ids(classes.names.size(), "classes");
    out.classes = std::move(classes.names);
    return out;
}

}  // namespace sonarsim
