#include "scene/gltf/reduced_json.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf/json_rules.h"

namespace sonarsim {

namespace {

using gltf_rules::Holds;
using gltf_rules::Kind;
using gltf_rules::Rule;
using nlohmann::json;

/// Receives the values of the document one by one from nlohmann's sax_parse, checks those that are
/// read and writes them down.
class Reducer {
  public:
    Reducer(const Rule& root, const std::string& file) : root_(root), file_(file) {}

    std::string take() {
        if (!has_version_) fail("asset.version is missing; expected glTF version 2.0");
        return std::move(out_);
    }

    bool null() { return scalar(json()); }
    bool boolean(bool value) { return scalar(value); }
    bool number_integer(json::number_integer_t value) { return scalar(value); }
    bool number_unsigned(json::number_unsigned_t value) { return scalar(value); }
    bool number_float(json::number_float_t value, const std::string&) { return scalar(value); }
    bool string(std::string& value) { return scalar(std::move(value)); }
    bool binary(json::binary_t&) { return false; }  // JSON text has no binary values

    bool start_object(std::size_t) { return open(empty_object_, '{'); }
    bool start_array(std::size_t) { return open(empty_array_, '['); }
    bool end_object() { return close('}'); }
    bool end_array() { return close(']'); }
    bool key(std::string& name) {
        if (dropped_ > 0) return true;
        Level& level = levels_.back();
        if (level.rule->key == "nodes") check_transform(name, level);
        level.member = nullptr;
        for (const Rule& rule : level.rule->members) {
            if (rule.key == name) level.member = &rule;
        }
        if (!level.member && level.rule->kind == Kind::sonar) {
            const std::array<std::string, 2> known{"material", "class"};
            fail(path(levels_.size() - 1) + ": unknown key '" + name + "'" +
                 did_you_mean(name, known) + "; only 'material' and 'class' are read");
        }
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string fault = error.what();
        fail(fault.substr(fault.find("] ") + 2));
    }

  private:
    /// An object or array that is read and still open.
    struct Level {
        const Rule* rule;
        bool is_array;
        std::size_t size = 0;          ///< elements so far, in an array
        const Rule* member = nullptr;  ///< rule of the current member, in an object; null: dropped
        bool has_matrix = false;
        bool has_parts = false;
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(Location{file_}, what);
    }

    /// The keys and indices that lead to the current value of level `depth` - 1.
    std::string path(std::size_t depth) const {
        std::string text;
        for (const Level& level : std::span(levels_).first(depth)) {
            if (level.is_array)
                text += "[" + std::to_string(level.size - 1) + "]";
            else
                text += (text.empty() ? "" : ".") + std::string(level.member->key);
        }
        return text;
    }

    /// tinygltf would silently drop the translation, rotation and scale of a node with a matrix.
    void check_transform(std::string_view key, Level& level) const {
        level.has_matrix |= key == "matrix";
        level.has_parts |= key == "translation" || key == "rotation" || key == "scale";
        if (level.has_matrix && level.has_parts) {
            fail(path(levels_.size() - 1) +
                 " has both a matrix and translation, rotation or scale");
        }
    }

    /// The rule of the value that begins now. Null if the value is dropped.
    const Rule* begin(const json& got) {
        if (dropped_ > 0) return nullptr;
        const Rule* rule = &root_;
        bool needs_array = false;
        if (!levels_.empty()) {
            Level& level = levels_.back();
            rule = level.is_array ? level.rule : level.member;
            needs_array = rule && rule->holds == Holds::array && !level.is_array;
            if (level.is_array) ++level.size;
        }
        if (!rule || (rule->kind == Kind::extras && !got.is_object())) return nullptr;
        const std::string needed = needs_array ? (got.is_array() ? "" : "an array")
                                               : gltf_rules::missing_type(rule->kind, got);
        if (needed.empty()) return rule;
        const std::string where = path(levels_.size());
        fail(where + (where.empty() ? "" : ": ") + "expected " + needed + ", not " +
             (got.is_number() ? got.dump() : got.type_name()));
    }

    void write(std::string_view text, std::size_t memory_bytes) {
        constexpr std::size_t max_bytes = std::size_t{1} << 30;
        memory_bytes_ += memory_bytes;
        if (memory_bytes_ > max_bytes) {
            fail(
                "describes so many nodes, meshes and accessors that they take more than 1 GiB of "
                "memory");
        }
        if (!levels_.empty()) {
            if (out_.back() != '{' && out_.back() != '[') out_ += ',';
            if (!levels_.back().is_array)
                out_.append("\"").append(levels_.back().member->key).append("\":");
        }
        out_ += text;
    }

    bool scalar(const json& value) {
        constexpr std::size_t bytes_per_value = 16;  // in tinygltf's JSON tree
        const Rule* rule = begin(value);
        if (!rule) return true;
        if (rule->kind == Kind::version) {
            const auto& version = value.get_ref<const std::string&>();
            if (!version.starts_with("2."))
                fail("is glTF version " + version.substr(0, 20) + "; expected 2.0");
            has_version_ = true;
        }
        std::string text = value.dump();
        if (rule->kind == Kind::uri && !text.starts_with("\"data:")) {
            // tinygltf decodes a plus sign as a blank.
            for (std::size_t at = 0; (at = text.find('+', at)) != std::string::npos;)
                text.replace(at, 1, "%2B");
        }
        write(text, bytes_per_value + (value.is_string() ? text.size() : 0));
        return true;
    }

    bool open(const json& empty, char bracket) {
        constexpr std::size_t bytes_per_container = 128;  // including its entry in the one around
        constexpr std::size_t max_objects = 2'000'000;
        constexpr int max_depth = 64;
        if (++depth_ > max_depth) fail("the JSON is nested more than 64 deep");
        const Rule* rule = begin(empty);
        if (!rule) {
            ++dropped_;
            return true;
        }
        if (empty.is_object() && ++objects_ > max_objects) {
            fail("holds more than " + std::to_string(max_objects) +
                 " nodes, meshes, accessors and so on");
        }
        write(std::string_view(&bracket, 1), bytes_per_container);
        levels_.push_back({rule, empty.is_array()});
        return true;
    }

    bool close(char bracket) {
        --depth_;
        if (dropped_ > 0) {
            --dropped_;
            return true;
        }
        const Level level = levels_.back();
        levels_.pop_back();
        out_ += bracket;
        if (level.is_array && level.rule->count > 0 && level.size != level.rule->count) {
            fail(path(levels_.size()) + ": expected " + std::to_string(level.rule->count) +
                 " numbers, not " + std::to_string(level.size));
        }
        return true;
    }

    const Rule& root_;
    const std::string& file_;
    const json empty_object_ = json::object();
    const json empty_array_ = json::array();
    std::string out_;
    std::vector<Level> levels_;
    int depth_ = 0;
    std::size_t dropped_ = 0;  ///< open objects and arrays that are not read
    std::size_t memory_bytes_ = 0;
    std::size_t objects_ = 0;
    bool has_version_ = false;
};

std::string reduced(std::string_view text, const Rule& root, const std::string& file) {
    Reducer reducer(root, file);
    json::sax_parse(text, &reducer);
    return reducer.take();
}

std::string checked(std::string_view text, const Rule& root, const std::string& file) {
    if (text.size() > std::size_t{1} << 28) {
        throw InputError(Location{file},
                         "holds more than 256 MiB of JSON; put the vertices into a .glb or a .bin "
                         "file");
    }
    try {
        return reduced(text, root, file);
    } catch (const InputError&) {
        // A file of another version is refused as such, wherever in the file its version stands.
        reduced(text, gltf_rules::only_version, file);
        throw;
    }
}

}  // namespace

std::string reduced_gltf_json(std::string_view text, const std::string& file) {
    return checked(text, gltf_rules::whole_document, file);
}

}  // namespace sonarsim
