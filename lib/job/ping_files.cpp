#include "job/ping_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/sha256_of_all.h"
#include "format/tar.h"
#include "job/journal.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// A ping's file is an image or JSON.
constexpr std::size_t largest_ping_file = std::size_t{1} << 32;

std::string read_part_of(const fs::path& path, std::uint64_t offset, std::uint64_t bytes) {
    if (bytes > largest_ping_file)
        throw InputError(
            {path.string()},
            "is said by the journal to hold a file of more than 4 GiB; copy both again");
    std::ifstream file(path, std::ios::binary);
    std::string read(bytes, '\0');
    if (!file.seekg(static_cast<std::streamoff>(offset)) ||
        !file.read(read.data(), static_cast<std::streamsize>(bytes)))
        throw InputError({path.string()}, "cannot be read to its end; copy it again");
    return read;
}

}  // namespace

std::vector<std::vector<std::string>> journal_fields(std::span<const PingToList> pings) {
    const auto is_record = [](const PingToList& ping, std::size_t k) {
        return std::holds_alternative<PingRecord>(ping.sensor.per_ping[k]);
    };
    std::vector<std::string_view> files;
    for (const PingToList& ping : pings) {
        for (std::size_t k = 0; k < ping.encoded.size(); ++k) {
            if (!is_record(ping, k)) files.push_back(ping.encoded[k]);
        }
    }
    std::vector<std::string> sums = sha256_of_all(files);
    std::vector<std::vector<std::string>> fields;
    std::size_t file = 0;
    for (const PingToList& ping : pings) {
        std::vector<std::string>& own = fields.emplace_back();
        for (std::size_t k = 0; k < ping.encoded.size(); ++k) {
            const std::string& bytes = ping.encoded[k];
            own.push_back(is_record(ping, k) ? hash_of_record(bytes)
                                             : entry_text({bytes.size(), std::move(sums[file++])}));
        }
    }
    return fields;
}

EncodedPing read_ping(const Layout& layout, const RecordFiles& records,
                      const FinishedPings& finished, const PingId& ping) {
    const SensorLayout& sensor = layout.sensors[ping.sensor];
    std::uint64_t member = sensor.pings_per_pack > 0 ? finished.begin_in_pack(ping) : 0;
    EncodedPing encoded;
    for (std::size_t k = 0; k < sensor.per_ping.size(); ++k) {
        const auto* file = std::get_if<PingFile>(&sensor.per_ping[k]);
        if (!file) {
            const RecordFile& source = *records[ping.sensor][k];
            std::string& bytes = encoded.emplace_back(source.record_bytes(), '\0');
            source.read(layout.record_of(ping), std::as_writable_bytes(std::span(bytes)));
        } else if (sensor.pings_per_pack == 0) {
            encoded.push_back(read_file(layout.file(ping, *file), largest_ping_file));
        } else {
            const std::uint64_t bytes = finished.bytes_of(ping, k);
            encoded.push_back(read_part_of(layout.pack_file(ping), member + tar_bytes(0), bytes));
            member += tar_bytes(bytes);
        }
    }
    return encoded;
}

PackFile::PackFile(const std::filesystem::path& path)
    : path_(path), fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)) {
    if (fd_ < 0) throw_errno("cannot write", path_);
}

PackFile::~PackFile() {
    if (fd_ >= 0) ::close(fd_);
}

void PackFile::write(std::uint64_t offset, std::string_view bytes) {
    if (fd_ < 0) fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    if (fd_ < 0) throw_errno("cannot write", path_);
    while (!bytes.empty()) {
        const ssize_t put = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) throw_errno("cannot write", path_);
        offset += static_cast<std::uint64_t>(put);
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
}

void PackFile::pause() {
    if (::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

void PackFile::finish(std::uint64_t bytes) {
    const bool cut = ::ftruncate(fd_, static_cast<off_t>(bytes)) == 0;
    if (!cut || ::close(std::exchange(fd_, -1)) != 0) throw_errno("cannot write", path_);
}

PingFiles::PingFiles(const Layout& layout, const RecordFiles& records, const FinishedPings& there)
    : layout_(layout), records_(records), there_(there), filling_(layout.sensors.size()) {
    const auto packed =
        std::ranges::count_if(layout.sensors, [](const auto& s) { return s.pings_per_pack > 0; });
    keep_open_ = static_cast<std::size_t>(packed) <= most_files_kept_open;
}

void PingFiles::write(const PingId& ping, const EncodedPing& encoded) const {
    const SensorLayout& sensor = layout_.sensors[ping.sensor];
    for (std::size_t k = 0; k < encoded.size(); ++k) {
        const auto* file = std::get_if<PingFile>(&sensor.per_ping[k]);
        if (!file) {
            records_[ping.sensor][k]->write(layout_.record_of(ping),
                                            std::as_bytes(std::span(encoded[k])));
        } else if (sensor.pings_per_pack == 0) {
            write_file(layout_.file(ping, *file), encoded[k]);
        }
    }
}

void PingFiles::pack(const PingId& ping, const EncodedPing& encoded) {
    const SensorLayout& sensor = layout_.sensors[ping.sensor];
    if (sensor.pings_per_pack == 0) return;
    std::uint64_t room = tar_end_bytes;
    for (const std::string& bytes : encoded)
        room += tar_bytes(bytes.size());
    std::string members;
    members.reserve(room);
    for (std::size_t k = 0; k < encoded.size(); ++k) {
        if (const auto* file = std::get_if<PingFile>(&sensor.per_ping[k]))
            append_to_tar(members, layout_.member(ping, *file), encoded[k]);
    }
    const std::size_t number = layout_.pack_of(ping);
    Filling& filling = filling_[ping.sensor];
    if (!filling.file || filling.number != number) {
        filling.file = std::make_unique<PackFile>(layout_.pack_file(ping));
        filling.number = number;
        filling.end = there_.begin_in_pack(ping);
    }
    const bool last = layout_.is_last_in_pack(ping);
    if (last) members.append(tar_end_bytes, '\0');
    filling.file->write(filling.end, members);
    filling.end += members.size();
    if (last) {
        filling.file->finish(filling.end);
        filling.file.reset();
    } else if (!keep_open_) {
        filling.file->pause();
    }
}

}  // namespace sonarsim
