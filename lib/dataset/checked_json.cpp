#include "dataset/checked_json.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "core/json_depth.h"
#include "core/text.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr int deepest = 64;
constexpr const char* cure = "; copy the dataset again, or render it anew";

/// As much of a value as a message shows.
std::string shown(const Json& json) {
    constexpr std::size_t longest = 60;
    if (json.is_object()) return "an object";
    if (json.is_array()) return "an array of " + std::to_string(json.size());
    const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

}  // namespace

Json read_json(const std::filesystem::path& path, std::size_t limit) {
    return parse_json(read_file(path, limit), path.string());
}

Json parse_json(const std::string& text, const std::string& file) {
    if (is_nested_deeper(text, deepest))
        throw InputError({file}, std::string("is nested more than 64 deep") + cure);
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) throw InputError({file}, std::string("is no JSON") + cure);
    return json;
}

std::optional<std::string> first_difference(const Json& one, const Json& other,
                                            const std::string& key) {
    if (one.is_object() && other.is_object()) {
        for (const auto& [name, value] : other.items()) {
            const std::string way = key.empty() ? name : key + "." + name;
            if (!one.contains(name)) return way;
            if (auto inner = first_difference(one.at(name), value, way)) return inner;
        }
        for (const auto& [name, value] : one.items()) {
            if (!other.contains(name)) return key.empty() ? name : key + "." + name;
        }
        return std::nullopt;
    }
    if (one.is_array() && other.is_array() && one.size() == other.size()) {
        for (std::size_t k = 0; k < one.size(); ++k) {
            const std::string way = key + "[" + std::to_string(k) + "]";
            if (auto inner = first_difference(one[k], other[k], way)) return inner;
        }
        return std::nullopt;
    }
    if (one.is_number_float() && other.is_number_float()) {
        const auto a = one.get<double>();
        const auto b = other.get<double>();
        if (std::fabs(a - b) <= 1e-9 * std::max({1.0, std::fabs(a), std::fabs(b)}))
            return std::nullopt;
    }
    return one == other ? std::nullopt : std::optional(key);
}

std::optional<CheckedJson> CheckedJson::find(const char* name) const {
    if (!json_->is_object()) refuse("an object");
    const auto found = json_->find(name);
    if (found == json_->end()) return std::nullopt;
    return member(name, *found);
}

CheckedJson CheckedJson::at(const char* name) const {
    std::optional<CheckedJson> found = find(name);
    if (found) return *std::move(found);
    throw InputError({*file_}, "lacks '" + (key_.empty() ? "" : key_ + ".") + name + "'" + cure);
}

std::vector<CheckedJson> CheckedJson::items() const {
    if (!json_->is_array()) refuse("an array");
    std::vector<CheckedJson> all;
    all.reserve(json_->size());
    for (const Json& item : *json_)
        all.push_back({item, *file_, key_ + "[" + std::to_string(all.size()) + "]"});
    return all;
}

std::vector<std::pair<std::string, CheckedJson>> CheckedJson::members() const {
    if (!json_->is_object()) refuse("an object");
    std::vector<std::pair<std::string, CheckedJson>> all;
    for (const auto& [name, value] : json_->items())
        all.emplace_back(name, member(name, value));
    return all;
}

std::string CheckedJson::text() const {
    if (!json_->is_string()) refuse("a text");
    return json_->get<std::string>();
}

bool CheckedJson::flag() const {
    if (!json_->is_boolean()) refuse("true or false");
    return json_->get<bool>();
}

std::uint64_t CheckedJson::whole(std::uint64_t low, std::uint64_t high) const {
    const bool is_whole = json_->is_number_unsigned();
    const std::uint64_t value = is_whole ? json_->get<std::uint64_t>() : 0;
    if (!is_whole || value < low || value > high) {
        refuse("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return value;
}

double CheckedJson::number() const {
    if (!json_->is_number()) refuse("a number");
    return json_->get<double>();
}

void CheckedJson::refuse(const std::string& right) const {
    const std::string what = key_.empty() ? "is " : "'" + printable(key_) + "' is ";
    throw InputError({*file_}, what + shown(*json_) + " and must be " + right + cure);
}

CheckedJson CheckedJson::member(const std::string& name, const Json& json) const {
    return {json, *file_, key_.empty() ? name : key_ + "." + name};
}

}  // namespace sonarsim
