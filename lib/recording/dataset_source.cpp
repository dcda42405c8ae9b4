#include "recording/dataset_source.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <system_error>

#include "core/error.h"
#include "dataset/file_names.h"
#include "format/tar.h"

namespace sonarsim {

namespace fs = std::filesystem;

std::optional<std::string> pattern_of(const NamedTexts& patterns, const std::string& kind) {
    for (const auto& [name, pattern] : patterns) {
        if (name == kind) return pattern;
    }
    return std::nullopt;
}

void for_each_ping_array(
    const DatasetSource& source, const std::string& pattern,
    const std::function<void(std::size_t, const RecordedArray&, const std::string&)>& visit) {
    const DescribedSensor& sensor = *source.sensor;
    if (!sensor.packs) {
        for (std::size_t k = 0; k < source.pings(); ++k) {
            const fs::path path = source.folder / numbered(pattern, k * sensor.every);
            visit(k, read_array_file(path), path.string());
        }
        return;
    }
    const std::uint64_t each = sensor.packs->pings;
    for (std::size_t first = 0; first < source.pings(); first += each) {
        const fs::path path = source.folder / numbered(sensor.packs->file, first / each);
        const std::size_t last = std::min<std::size_t>(first + each, source.pings());
        std::map<std::string, std::size_t> wanted;
        for (std::size_t k = first; k < last; ++k)
            wanted[numbered(pattern, k * sensor.every)] = k;
        try {
            for_each_in_tar(path, [&](const std::string& name, const std::string& bytes) {
                const auto found = wanted.find(name);
                if (found == wanted.end()) return;
                visit(found->second, read_array(bytes, path.string() + "/" + name), name);
                wanted.erase(found);
            });
        } catch (const std::system_error&) {
            throw;
        } catch (const InputError&) {
            throw;
        } catch (const std::runtime_error& fault) {
            throw InputError({path.string()}, fault.what());
        }
        if (!wanted.empty()) throw InputError({path.string()}, "lacks " + wanted.begin()->first);
    }
}

std::vector<double> middles(const CheckedJson& edges) {
    std::vector<double> out;
    const std::vector<CheckedJson> all = edges.items();
    for (std::size_t k = 0; k + 1 < all.size(); ++k)
        out.push_back(0.5 * (all[k].number() + all[k + 1].number()));
    return out;
}

}  // namespace sonarsim
