#include "mission/json_values.h"

#include <cmath>
#include <optional>

#include "core/text.h"

namespace sonarsim {

void refuse_at(const YamlNode& node, const std::string& what) {
    throw InputError(node.place.location(), what);
}

const YamlNode& map_at(const YamlNode& node, const std::string& name) {
    if (node.kind != YamlNode::Kind::map) refuse_at(node, "'" + name + "' must be an object");
    return node;
}

double number_in(const YamlNode& node, const std::string& name, const Limits& limits) {
    const bool plain = node.kind == YamlNode::Kind::scalar && !node.quoted;
    const std::optional<double> value = plain ? parse_number(node.text) : std::nullopt;
    if (!value || !std::isfinite(*value)) refuse_at(node, "'" + name + "' must be a number");
    const bool low = limits.low_allowed ? *value < limits.low : *value <= limits.low;
    if (low || *value > limits.high) {
        refuse_at(node, "'" + name + "' must be " + (limits.low_allowed ? "from " : "above ") +
                            number_text(limits.low) +
                            (limits.low_allowed ? " to " : " and at most ") +
                            number_text(limits.high) + ", not " + node.text);
    }
    return *value;
}

bool flag_in(const YamlNode& node, const std::string& name) {
    const bool yes = node.text == "true";
    if (node.kind != YamlNode::Kind::scalar || node.quoted || (!yes && node.text != "false"))
        refuse_at(node, "'" + name + "' must be true or false");
    return yes;
}

std::string text_in(const YamlNode& node, const std::string& name) {
    if (node.kind != YamlNode::Kind::scalar) refuse_at(node, "'" + name + "' must be text");
    return node.text;
}

std::array<double, 3> vector_in(const YamlNode& object, const char* key, const Limits& limits) {
    std::array<double, 3> values{};
    const YamlNode* const node = object.find(key);
    if (node == nullptr) return values;
    if (node->kind != YamlNode::Kind::list || node->items.size() != 3)
        refuse_at(*node, "'" + std::string(key) + "' must be a list of 3 numbers");
    for (std::size_t k = 0; k < 3; ++k)
        values[k] = number_in(node->items[k], key, limits);
    return values;
}

}  // namespace sonarsim
