#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "format/byte_fields.h"
#include "format/water_column.h"

namespace sonarsim {

namespace {

// Kongsberg, "EM Series Multibeam echo sounder, Datagram formats": a length, then a datagram of
// that length. It begins with 0x02; its third byte from the end is 0x03. Offsets count from the end
// of the length. Kongsberg's programs for PCs write little-endian numbers, older ones for Unix
// big-endian ones.
constexpr char all_begin = 0x02, all_end = 0x03, water_type = 'k';
constexpr std::size_t shortest_datagram = 19;
constexpr std::size_t all_sectors_at = 40, all_sector_length = 6, all_beam_entry = 10;

/// A datagram and the order of its bytes.
struct AllDatagram {
    std::string_view bytes;
    bool is_big_endian = false;

    template <class T>
    T get(std::size_t at) const {
        return field_at<T>(bytes, at, is_big_endian);
    }
};

/// The datagram that begins at offset `at`; nullopt if none does.
std::optional<AllDatagram> all_datagram(std::string_view bytes, std::size_t at,
                                        bool is_big_endian) {
    if (bytes.size() - at < 4) return std::nullopt;
    const std::size_t length = field_at<std::uint32_t>(bytes, at, is_big_endian);
    if (length < shortest_datagram || length > bytes.size() - at - 4) return std::nullopt;
    const std::string_view datagram = bytes.substr(at + 4, length);
    if (datagram[0] != all_begin || datagram[length - 3] != all_end) return std::nullopt;
    return AllDatagram{datagram, is_big_endian};
}

/// Seconds since 1970 of a date, 20041023 for the 23rd of October 2004, and of milliseconds of the
/// day.
double time_of_day(std::uint32_t date, std::uint32_t ms) {
    using namespace std::chrono;
    const year_month_day day(year(static_cast<int>(date / 10000)), month(date / 100 % 100),
                             std::chrono::day(date % 100));
    if (date > 99999999 || !day.ok()) throw std::runtime_error("has a ping without a date");
    return 86400.0 * static_cast<double>(sys_days(day).time_since_epoch().count()) + 1e-3 * ms;
}

/// A ping and the numbers that identify it; several datagrams may hold its beams.
struct AllPing {
    WaterPing ping;
    std::uint16_t counter = 0;
    std::uint16_t serial = 0;   ///< the head's
    std::size_t all_beams = 0;  ///< number of beams in all of its datagrams
};

AllPing head_of_ping(const AllDatagram& datagram) {
    AllPing out;
    out.ping.t_s = time_of_day(datagram.get<std::uint32_t>(4), datagram.get<std::uint32_t>(8));
    out.counter = datagram.get<std::uint16_t>(12);
    out.serial = datagram.get<std::uint16_t>(14);
    out.all_beams = datagram.get<std::uint16_t>(22);
    out.ping.sound_speed_m_s = 0.1 * datagram.get<std::uint16_t>(26);
    out.ping.sample_hz = 0.01 * datagram.get<std::uint32_t>(28);
    if (datagram.get<std::uint16_t>(20) > 0)
        out.ping.frequency_hz = 10.0 * datagram.get<std::uint16_t>(all_sectors_at + 2);
    check_water(out.ping);
    return out;
}

void add_all_beams(const AllDatagram& datagram, WaterPing& ping) {
    const std::size_t sectors = datagram.get<std::uint16_t>(20);
    const std::size_t count = datagram.get<std::uint16_t>(24);
    std::size_t at = all_sectors_at + sectors * all_sector_length;
    for (std::size_t k = 0; k < count; ++k) {
        WaterBeam beam;
        beam.angle_deg = 0.01 * datagram.get<std::int16_t>(at);
        beam.first = datagram.get<std::uint16_t>(at + 2);
        const std::size_t samples = datagram.get<std::uint16_t>(at + 4);
        at += all_beam_entry;
        if (at > datagram.bytes.size() || datagram.bytes.size() - at < samples)
            throw std::runtime_error("has a beam with more samples than their datagram");
        beam.samples = datagram.bytes.substr(at, samples);
        at += samples;
        ping.add(beam);
    }
}

}  // namespace

bool is_all_file(std::string_view bytes) {
    return all_datagram(bytes, 0, false) || all_datagram(bytes, 0, true);
}

SonarLog read_all(std::string_view bytes, std::size_t most_pings) {
    const bool is_big_endian = !all_datagram(bytes, 0, false);
    std::vector<WaterPing> pings;
    std::optional<AllPing> open;
    std::optional<std::uint16_t> serial;
    const auto close = [&] {
        if (open && open->ping.beams.size() == open->all_beams)
            pings.push_back(std::move(open->ping));
        open.reset();
    };
    for (std::size_t at = 0; at < bytes.size() && pings.size() < most_pings;) {
        const auto datagram = all_datagram(bytes, at, is_big_endian);
        if (!datagram)
            throw std::runtime_error("has no datagram where one should begin, or is cut off");
        at += 4 + datagram->bytes.size();
        if (datagram->bytes[1] != water_type) continue;
        AllPing own = head_of_ping(*datagram);
        if (!serial) serial = own.serial;
        if (own.serial != *serial) continue;
        if (!open || open->counter != own.counter || open->ping.t_s != own.ping.t_s) {
            close();
            open = std::move(own);
        }
        add_all_beams(*datagram, open->ping);
        if (open->ping.beams.size() >= open->all_beams) close();
    }
    return log_of_water(pings, "has no water column (datagrams 'k', in .all or .wcd files)");
}

}  // namespace sonarsim
