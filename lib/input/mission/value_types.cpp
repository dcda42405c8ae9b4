#include "input/mission/value_types.h"

#include <cmath>

#include "core/error.h"

namespace sonarsim {

namespace {

/// Describes the node for "must be ..., not ...".
std::string found(const YamlNode& node) {
    switch (node.kind) {
        case YamlNode::Kind::empty:
            return "nothing";
        case YamlNode::Kind::list:
            return node.items.empty() ? "an empty list" : "a list";
        case YamlNode::Kind::map:
            return "a section of keys";
        case YamlNode::Kind::scalar:
            break;
    }
    return node.quoted ? "the quoted text " + in_quotes(node.text) : in_quotes(node.text);
}

/// True if the node is a word or number without quotes.
bool is_plain(const YamlNode& node) {
    return node.kind == YamlNode::Kind::scalar && !node.quoted;
}

void check_limits(const YamlNode& node, const char* key, double value, const Limits& limits) {
    const std::string fault = fault_of(value, limits);
    if (!fault.empty()) refuse_type(node, key, fault);
}

double read_number(const YamlNode& node, const char* key, const Limits& limits) {
    const std::optional<double> value = is_plain(node) ? parse_number(node.text) : std::nullopt;
    if (!value || !std::isfinite(*value)) refuse_type(node, key, "a finite number");
    check_limits(node, key, *value, limits);
    return *value;
}

std::string read_text(const YamlNode& node, const char* key) {
    if (node.kind != YamlNode::Kind::scalar) refuse_type(node, key, "text");
    if (node.text.empty()) refuse(node.place, "'{}' must not be empty", key);
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::ranges::any_of(node.text, is_control))
        refuse(node.place, "'{}' must not hold control characters", key);
    return node.text;
}

}  // namespace

std::string fault_of(double value, const Limits& limits) {
    const bool too_low = limits.low_allowed ? value < limits.low : value <= limits.low;
    if (too_low) return (limits.low_allowed ? "at least " : "above ") + number_text(limits.low);
    return value <= limits.high ? "" : "at most " + number_text(limits.high);
}

void refuse_type(const YamlNode& node, const std::string& key, const std::string& wanted) {
    refuse(node.place, "'{}' must be {}, not {}", key, wanted, found(node));
}

void FlagType::read(const YamlNode& node, const char* key, bool& value) const {
    value = node.text == "true";
    if (is_plain(node) && (value || node.text == "false")) return;
    refuse_type(node, key, "true or false");
}

void PathType::read(const YamlNode& node, const char* key, std::filesystem::path& path,
                    const std::filesystem::path& base_folder) const {
    path = std::filesystem::absolute(base_folder / read_text(node, key)).lexically_normal();
}

void PathType::read(const YamlNode& node, const char* key,
                    std::vector<std::filesystem::path>& paths,
                    const std::filesystem::path& base_folder) const {
    const bool is_list = node.kind == YamlNode::Kind::list;
    if (is_list && node.items.empty()) refuse_type(node, key, "a path or a list of one or more");
    paths.clear();
    for (const YamlNode& item : is_list ? node.items : std::vector{node})
        read(item, key, paths.emplace_back(), base_folder);
}

void NumberType::read(const YamlNode& node, const char* key, double& value) const {
    std::optional<double> number;
    if (automatic) {
        read(node, key, number);
    } else {
        number = read_number(node, key, limits);
    }
    value = number.value_or(0.0);
}

void NumberType::read(const YamlNode& node, const char* key, int& value) const {
    const std::optional<std::int64_t> number =
        is_plain(node) ? parse_integer(node.text) : std::nullopt;
    if (!number) refuse_type(node, key, "a whole number");
    check_limits(node, key, static_cast<double>(*number), limits);
    value = static_cast<int>(*number);
}

void NumberType::read(const YamlNode& node, const char* key, std::uint64_t& value) const {
    const std::optional<std::uint64_t> number =
        is_plain(node) ? parse_unsigned(node.text) : std::nullopt;
    if (!number) refuse_type(node, key, "a whole number from 0 to 2^64 - 1");
    value = *number;
}

void NumberType::read(const YamlNode& node, const char* key, std::optional<double>& value) const {
    value.reset();
    if (node.kind == YamlNode::Kind::scalar && node.text == "auto") return;
    if (!is_plain(node) || !parse_number(node.text)) refuse_type(node, key, "auto or a number");
    value = read_number(node, key, limits);
}

void NumberType::read(const YamlNode& node, const char* key, std::array<double, 2>& value) const {
    if (node.kind != YamlNode::Kind::list) {
        value.fill(read_number(node, key, limits));
        return;
    }
    ArrayType{limits}.read(node, key, value);
    if (value[0] <= value[1]) return;
    refuse(node.place, "'{}': the first number must not be above the second, in [{}, {}]", key,
           number_text(value[0]), number_text(value[1]));
}

void ArrayType::read(const YamlNode& node, const char* key, std::span<double> values) const {
    const std::string wanted = "a list of " + std::to_string(values.size()) + " numbers";
    if (node.kind != YamlNode::Kind::list) refuse_type(node, key, wanted);
    if (node.items.size() != values.size())
        refuse(node.place, "'{}' must be {}, not of {}", key, wanted, node.items.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = read_number(node.items[i], key, limits);
}

void TextType::read(const YamlNode& node, const char* key, std::string& value) const {
    value = read_text(node, key);
}

void TextType::read(const YamlNode& node, const char* key, std::vector<std::string>& values) const {
    if (node.kind != YamlNode::Kind::list) refuse_type(node, key, "a list of texts");
    values.clear();
    for (const YamlNode& item : node.items)
        values.push_back(read_text(item, key));
}

void TextType::read(const YamlNode& node, const char* key, Renaming& values) const {
    if (node.kind != YamlNode::Kind::map) refuse_type(node, key, "a section of names");
    values.clear();
    for (const YamlNode& item : node.items)
        values.emplace_back(item.key, read_text(item, key));
}

void TextType::read(const YamlNode& node, const char* key, YamlValues& values) const {
    if (node.kind != YamlNode::Kind::list || node.items.empty())
        refuse_type(node, key, "a list of one or more values");
    values.items.clear();
    for (const YamlNode& item : node.items)
        values.items.push_back(flow_text(item));
}

std::size_t index_of(const YamlNode& node, const char* key, const std::vector<std::string>& names) {
    if (node.kind != YamlNode::Kind::scalar) refuse_type(node, key, "one of: " + listed(names));
    const auto name = std::ranges::find(names, node.text);
    if (name == names.end()) {
        refuse(node.place, "unknown {} {}{}; known: {}", key, in_quotes(node.text),
               did_you_mean(node.text, names), listed(names));
    }
    return static_cast<std::size_t>(name - names.begin());
}

std::vector<bool> chosen_of(const YamlNode& node, const char* key,
                            const std::vector<std::string>& names) {
    const bool all = is_plain(node) && node.text == "true";
    std::vector<bool> chosen(names.size(), all);
    if (all || (is_plain(node) && node.text == "false")) return chosen;
    if (node.kind != YamlNode::Kind::list)
        refuse_type(node, key, "true, false or a list of: " + listed(names));
    for (const YamlNode& item : node.items) {
        const std::size_t index = index_of(item, key, names);
        if (chosen[index]) refuse(item.place, "{} stands twice in '{}'", in_quotes(item.text), key);
        chosen[index] = true;
    }
    return chosen;
}

}  // namespace sonarsim
