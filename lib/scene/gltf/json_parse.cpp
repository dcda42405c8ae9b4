#include "scene/gltf/json_parse.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/json_depth.h"
#include "scene/gltf/json_rules.h"

namespace sonarsim {

namespace {

using gltf_rules::Kind;
using gltf_rules::Rule;
using nlohmann::json;

constexpr std::size_t max_json_bytes = std::size_t{1} << 28;
constexpr std::size_t max_kept_bytes = std::size_t{1} << 30;
constexpr std::size_t bytes_per_value = 16;       // a scalar in an array
constexpr std::size_t bytes_per_container = 128;  // including its entry in the container around it
constexpr int max_depth = 64;

/// nlohmann's own check of the depth takes time quadratic in the length of an array.
void check_depth(std::string_view text, const std::string& file) {
    if (is_nested_deeper(text, max_depth))
        throw InputError(Location{file}, "the JSON is nested more than 64 deep");
}

/// The parts of a value that are kept. Scalars are always kept.
struct Keep {
    std::span<const Rule> members;   ///< members of an object
    const Rule* elements = nullptr;  ///< rule of an array
    bool all = false;                ///< keep every member or element
};

/// The parts of a value that the member `rule` keeps.
Keep keep_by(const Rule& rule) {
    switch (rule.kind) {
        case Kind::object:
            return {.members = rule.members, .elements = nullptr};
        case Kind::extras:
            return {.members = gltf_rules::extras_members, .elements = nullptr};
        case Kind::anything:
            return {.members = {}, .elements = nullptr, .all = true};
        case Kind::names:
        case Kind::indices:
        case Kind::numbers:
        case Kind::objects:
            return {.members = {}, .elements = &rule};
        default:
            return {};
    }
}

/// Receives the values of the document one by one from nlohmann's sax_parse.
class Keeper {
  public:
    explicit Keeper(const std::string& file) : file_(file) {}

    json take() { return std::move(root_); }
    const std::string& fault() const { return fault_; }

    bool null() { return scalar(json()); }
    bool boolean(bool value) { return scalar(value); }
    bool number_integer(json::number_integer_t value) { return scalar(value); }
    bool number_unsigned(json::number_unsigned_t value) { return scalar(value); }
    bool number_float(json::number_float_t value, const std::string&) { return scalar(value); }
    bool string(std::string& value) {
        if (is_kept()) spend(value.size());
        return scalar(std::move(value));
    }
    bool binary(json::binary_t&) { return false; }  // JSON text has no binary values

    bool start_object(std::size_t) { return open(json::object()); }
    bool start_array(std::size_t) { return open(json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        if (forgotten_ > 0) return true;
        Level& level = levels_.back();
        level.rule = gltf_rules::find_rule(level.keep.members, name);
        level.member_is_kept = level.rule != nullptr || level.keep.all;
        level.key = std::move(name);
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const json::exception& error) {
        fault_ = error.what();
        return false;
    }

  private:
    /// An object or array that is kept and still open.
    struct Level {
        json* container;
        Keep keep;
        std::string key = {};  ///< key of the next member, in an object
        const Rule* rule = nullptr;
        bool member_is_kept = false;
    };

    /// True if the next value is kept.
    bool is_kept() const {
        if (forgotten_ > 0) return false;
        if (levels_.empty()) return true;
        const Level& level = levels_.back();
        if (level.container->is_object()) return level.member_is_kept;
        return level.keep.all || level.keep.elements != nullptr;
    }

    void spend(std::size_t bytes) {
        kept_bytes_ += bytes;
        if (kept_bytes_ > max_kept_bytes) {
            throw InputError(Location{file_},
                             "describes so many nodes, meshes and accessors that they take more "
                             "than 1 GiB of memory");
        }
    }

    json* put(json&& value) {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Level& level = levels_.back();
        if (level.container->is_object()) {
            json& member = (*level.container)[level.key];
            member = std::move(value);
            return &member;
        }
        level.container->push_back(std::move(value));
        return &level.container->back();
    }

    bool scalar(json&& value) {
        if (!is_kept()) return true;
        spend(bytes_per_value);
        put(std::move(value));
        return true;
    }

    bool open(json&& container) {
        if (!is_kept()) {
            ++forgotten_;
            return true;
        }
        spend(bytes_per_container);
        const Keep keep = keep_of_next();
        levels_.push_back({put(std::move(container)), keep});
        return true;
    }

    bool close() {
        forgotten_ > 0 ? void(--forgotten_) : levels_.pop_back();
        return true;
    }

    Keep keep_of_next() const {
        if (levels_.empty()) return {.members = gltf_rules::root, .elements = nullptr};
        const Level& level = levels_.back();
        if (level.keep.all) return level.keep;
        if (level.container->is_object()) return keep_by(*level.rule);
        const Rule& array = *level.keep.elements;
        return array.kind == Kind::objects ? Keep{.members = array.members, .elements = nullptr}
                                           : Keep{};
    }

    const std::string& file_;
    json root_;
    std::vector<Level> levels_;
    std::size_t forgotten_ = 0;  ///< open objects and arrays that are not kept
    std::size_t kept_bytes_ = 0;
    std::string fault_;
};

}  // namespace

json parse_gltf_json(std::string_view text, const std::string& file) {
    if (text.size() > max_json_bytes) {
        throw InputError(Location{file},
                         "holds more than 256 MiB of JSON; put the vertices into a "
                         ".glb or a .bin file");
    }
    check_depth(text, file);
    Keeper keeper(file);
    if (json::sax_parse(text, &keeper)) return keeper.take();
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string& fault = keeper.fault();
    const std::size_t bracket = fault.find("] ");
    throw InputError(Location{file},
                     bracket == std::string::npos ? fault : fault.substr(bracket + 2));
}

}  // namespace sonarsim
