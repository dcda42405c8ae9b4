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

void MissionWriter::text(const char* key, std::string_view value, const char* /*meaning*/) {
    if (!value.empty()) line(key, scalar_text(value));
}

void MissionWriter::path(const char* key, const std::filesystem::path& value,
                         const char* /*meaning*/, Presence) {
    if (!value.empty()) line(key, scalar_text(value.string()));
}

/// Text stands in quotes always: a sensor named "null" stays one.
std::string MissionWriter::scalar_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
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
