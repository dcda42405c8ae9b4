#include "job/checksums.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file.h"
#include "core/sha256.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t digits_of_sum = 64;

/// Adds the sums of the pings' files, in the order of the writers.
void add_ping_files(StreamedFile& sums, const Layout& layout, std::uint32_t sensor,
                    const JournalEntries& entries) {
    const SensorLayout& own = layout.sensors[sensor];
    for (std::size_t k = 0; k < own.per_ping.size(); ++k) {
        const auto* file = std::get_if<PingFile>(&own.per_ping[k]);
        if (!file) continue;
        for (std::uint32_t ping = 0; ping < own.pings; ++ping) {
            const PingId id{ping * own.every, sensor};
            const auto fields = entries.pings.find(id);
            const auto entry =
                fields && k < fields->size() ? parse_entry(fields->at(k)) : std::nullopt;
            const fs::path path = layout.file(id, *file);
            if (!entry) throw std::runtime_error("the journal does not list " + path.string());
            sums.append(
                checksum_line(entry->sha256, path.lexically_relative(layout.folder).string()));
        }
    }
}

bool stays_below(const fs::path& name) {
    return !name.empty() && name.is_relative() &&
           std::ranges::none_of(name, [](const fs::path& step) { return step == ".."; });
}

}  // namespace

void write_checksums(const Layout& layout, const JournalEntries& entries,
                     const std::string& description) {
    StreamedFile sums(layout.folder / checksums_name);
    const auto add_file = [&](const std::string& name) {
        sums.append(checksum_line(sha256_of_file(layout.folder / name), name));
    };
    sums.append(checksum_line(sha256(description), description_name));
    for (const char* name : {mission_name, trajectory_name, journal_name})
        add_file(name);
    for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        add_ping_files(sums, layout, i, entries);
        for (const auto& part : sensor.per_ping) {
            if (const auto* record = std::get_if<PingRecord>(&part))
                add_file(sensor.name + "/" + record->file);
        }
        for (const std::string& product : sensor.products)
            add_file(sensor.name + "/" + product);
    }
    for (const std::string& product : layout.products)
        add_file(product);
    sums.finish();
}

std::string checksum_line(const std::string& sum, const std::string& name) {
    return sum + "  " + name + '\n';
}

std::map<std::string, std::string> read_checksums(const fs::path& file) {
    constexpr std::size_t largest = std::size_t{1} << 32;
    std::map<std::string, std::string> sums;
    std::istringstream lines(read_file(file, largest));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::string sum = line.substr(0, digits_of_sum);
        const std::string blanks = line.substr(sum.size(), 2);
        const std::string name = line.substr(sum.size() + blanks.size());
        const bool sound = sum.size() == digits_of_sum &&
                           sum.find_first_not_of("0123456789abcdef") == std::string::npos &&
                           // The last line of a file that was cut off has no line feed.
                           blanks == "  " && stays_below(name) && !lines.eof();
        if (!sound) {
            throw InputError({file.string(), number},
                             "is not a SHA-256 sum, two blanks and the name of a file of the "
                             "dataset; remove SHA256SUMS, and the render command that made the "
                             "dataset writes it again");
        }
        sums[name] = sum;
    }
    return sums;
}

}  // namespace sonarsim
