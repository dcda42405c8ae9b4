#include "dataset/ping_file_reader.h"

#include <stdexcept>

#include "core/file.h"
#include "format/tar.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_loose_file = std::size_t{1} << 30;

}  // namespace

PingFileReader::PingFileReader(const Layout& layout)
    : layout_(layout), packs_(layout.sensors.size()) {}

std::string PingFileReader::read(const PingId& ping, const PingFile& kind) {
    if (layout_.packs(ping.sensor) == 0)
        return read_file(layout_.file(ping, kind), largest_loose_file);
    OpenPack& pack = packs_[ping.sensor];
    const std::filesystem::path path = layout_.pack_file(ping);
    if (pack.path != path || pack.kind != kind.name) {
        pack = {path, kind.name, {}};
        const std::string end = "." + kind.name + kind.extension;
        for_each_in_tar(path, [&](const std::string& name, const std::string& bytes) {
            if (name.ends_with(end)) pack.files.emplace(name, bytes);
        });
    }
    const std::string name = layout_.member(ping, kind);
    const auto file = pack.files.find(name);
    if (file == pack.files.end()) throw std::runtime_error(path.string() + ": lacks " + name);
    return file->second;
}

std::string place_of_file(const Layout& layout, const PingId& ping, const PingFile& kind) {
    const auto inside = [&](const std::filesystem::path& path) {
        return path.lexically_relative(layout.folder).generic_string();
    };
    if (layout.packs(ping.sensor) == 0) return inside(layout.file(ping, kind));
    return inside(layout.pack_file(ping)) + "/" + layout.member(ping, kind);
}

}  // namespace sonarsim
