#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sonarsim {

/// The JSON of a file of a dataset. InputError with the file when it cannot be read, is longer than
/// `limit` bytes, is no JSON or is nested more than 64 deep.
nlohmann::ordered_json read_json(const std::filesystem::path& path, std::size_t limit);
/// The same for a text; `file` is for the messages.
nlohmann::ordered_json parse_json(const std::string& text, const std::string& file);

/// The path of the first value in which two trees differ: "sensors[0].name"; nothing if they are
/// equal. `key` is the path of the trees. Numbers are equal if they differ by no more than
/// rounding. The order of keys does not count.
std::optional<std::string> first_difference(const nlohmann::ordered_json& one,
                                            const nlohmann::ordered_json& other,
                                            const std::string& key = "");

/// A value in the JSON of a file, with its path. A value of another type or range throws an
/// InputError that names the file, the key, the value and what it must be. The JSON and the name of
/// the file must outlive it.
class CheckedJson {
  public:
    CheckedJson(const nlohmann::ordered_json& json, const std::string& file)
        : json_(&json), file_(&file) {}

    /// A member of an object; nothing if it has none of this name.
    std::optional<CheckedJson> find(const char* name) const;
    /// A member that must be there.
    CheckedJson at(const char* name) const;
    /// The elements of an array.
    std::vector<CheckedJson> items() const;
    /// The members of an object.
    std::vector<std::pair<std::string, CheckedJson>> members() const;

    std::string text() const;
    bool flag() const;
    /// A whole number within these bounds, both included.
    std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
    double number() const;

    const nlohmann::ordered_json& json() const { return *json_; }

    /// `right`: what it must be, "a text".
    [[noreturn]] void refuse(const std::string& right) const;

  private:
    CheckedJson(const nlohmann::ordered_json& json, const std::string& file, std::string key)
        : json_(&json), file_(&file), key_(std::move(key)) {}
    CheckedJson member(const std::string& name, const nlohmann::ordered_json& json) const;

    const nlohmann::ordered_json* json_;
    const std::string* file_;
    std::string key_;  ///< "sensors[0].name"; empty for the whole
};

}  // namespace sonarsim
