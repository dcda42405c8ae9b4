#include "mission/writer.h"

#include <algorithm>

#include "core/text.h"

namespace sonarsim {

void MissionWriter::number(const char* key, double value, const Limits&, const char* /*meaning*/,
                           Presence) {
    line(key, number_text(value));
}

void MissionWriter::number_or_auto(const char* key, double value, const Limits&,
                                   const char* /*meaning*/) {
    line(key, value == 0.0 ? "auto" : number_text(value));
}

void MissionWriter::number_or_auto(const char* key, const std::optional<double>& value,
                                   const Limits&, const char* /*meaning*/) {
    line(key, value ? number_text(*value) : "auto");
}

void MissionWriter::integer(const char* key, int value, const Limits&, const char* /*meaning*/) {
    line(key, std::to_string(value));
}

void MissionWriter::integer(const char* key, std::uint64_t value, const char* /*meaning*/) {
    line(key, std::to_string(value));
}

const SonarKeys& MissionWriter::sonar_kind(const char* key, const SonarConfig& value,
                                           const char* /*meaning*/) {
    const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
    line(key, keys->name);
    return *keys;
}

void MissionWriter::flag(const char* key, bool value, const char* /*meaning*/) {
    line(key, value ? "true" : "false");
}

// Text is always quoted, so that a sensor named "null" stays text.

void MissionWriter::text(const char* key, std::string_view value, const char* /*meaning*/,
                         Presence) {
    if (!value.empty()) line(key, quoted_text(value));
}

void MissionWriter::texts(const char* key, const std::vector<std::string>& values,
                          const char* /*meaning*/) {
    std::string list;
    for (const std::string& value : values)
        list += (list.empty() ? "[" : ", ") + quoted_text(value);
    if (!list.empty()) line(key, list + "]");
}

void MissionWriter::renaming(const char* key,
                             const std::vector<std::pair<std::string, std::string>>& values,
                             const char* /*meaning*/) {
    std::string map;
    for (const auto& [from, to] : values)
        map += (map.empty() ? "{" : ", ") + quoted_text(from) + ": " + quoted_text(to);
    if (!map.empty()) line(key, map + "}");
}

void MissionWriter::values(const char* key, const std::vector<std::string>& values,
                           const char* /*meaning*/) {
    std::string list;
    for (const std::string& value : values)
        list += (list.empty() ? "[" : ", ") + value;
    if (!list.empty()) line(key, list + "]");
}

void MissionWriter::range(const char* key, const std::array<double, 2>& value, const Limits&,
                          const char* /*meaning*/) {
    write_list(key, value.data(), value.size());
}

void MissionWriter::path(const char* key, const std::filesystem::path& value,
                         const char* /*meaning*/, Presence) {
    if (!value.empty()) line(key, quoted_text(value.string()));
}

void MissionWriter::paths(const char* key, const std::vector<std::filesystem::path>& values,
                          const char* meaning, Presence) {
    std::vector<std::string> names;
    for (const std::filesystem::path& value : values)
        names.push_back(value.string());
    texts(key, names, meaning);
}

void MissionWriter::write_list(const char* key, const double* values, std::size_t count) {
    std::string list;
    for (std::size_t i = 0; i < count; ++i) {
        list += (i == 0 ? "[" : ", ") + number_text(values[i]);
    }
    line(key, list + "]");
}

void MissionWriter::line(std::string_view key, std::string_view value) {
    yaml_.append(item_ ? indent_ - 2 : indent_, ' ');
    if (item_) yaml_ += "- ";
    item_ = false;
    yaml_.append(key).append(":");
    if (!value.empty()) yaml_.append(" ").append(value);
    yaml_ += '\n';
}

}  // namespace sonarsim
