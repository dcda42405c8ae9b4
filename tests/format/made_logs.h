#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "format/made_bytes.h"

namespace sonarsim::test {

struct MadeBeam {
    double angle_deg = 0.0;
    int first = 0;
    std::vector<int> levels;  ///< steps of 0.5 dB
};

/// A datagram of a .kmall; `content` follows the header.
inline std::string kmall_datagram(const char* type, std::uint32_t seconds,
                                  const std::string& content) {
    MadeBytes out;
    out.u32(static_cast<std::uint32_t>(20 + content.size() + 4));
    out.text += type;
    out.add<std::uint8_t>(1).add<std::uint8_t>(0).u16(2040).u32(seconds).u32(500000000U);
    out.text += content;
    return out.u32(static_cast<std::uint32_t>(out.text.size() + 4)).text;
}

/// Water column: `fan` is the number of the receiving fan, `phase` the bytes of a phase; blocks
/// have `more` bytes at their end that nobody knows.
inline std::string kmall_water(std::uint32_t seconds, const std::vector<MadeBeam>& beams,
                               int phase = 0, int fan = 0, int more = 0) {
    const std::string unknown(static_cast<std::size_t>(more), '\x7f');
    MadeBytes out;
    out.u16(1).u16(1);  // one partition, the first
    out.u16(12 + more).u16(7).add<std::uint8_t>(2).add(static_cast<std::uint8_t>(fan));
    out.u32(0).u16(0);
    out.text += unknown;
    out.u16(12 + more).u16(1).u16(16 + more).u16(0).f32(0.0);
    out.text += unknown;
    out.f32(0.0).f32(3e5).f32(1.0).u16(0).u16(0);
    out.text += unknown;
    out.u16(16 + more).u16(static_cast<int>(beams.size()));
    out.add(static_cast<std::uint8_t>(16 + more)).add(static_cast<std::uint8_t>(phase));
    out.u16(0).f32(3000.0).f32(1500.0);
    out.text += unknown;
    for (const MadeBeam& beam : beams) {
        out.f32(beam.angle_deg).u16(beam.first).u16(0).u16(0);
        out.u16(static_cast<int>(beam.levels.size())).f32(0.0);
        out.text += unknown;
        for (const int level : beam.levels)
            out.add(static_cast<std::int8_t>(level));
        out.text += std::string(beam.levels.size() * static_cast<std::size_t>(phase), '\x11');
    }
    return kmall_datagram("#MWC", seconds, out.text);
}

/// A sounding of a .kmall, below the vessel's reference point and to starboard of it.
struct MadeSounding {
    double below_m = 0.0;
    double across_m = 0.0;
    double two_way_s = 0.0;
    double level_db = 0.0;
    int type = 0;  ///< 0: normal, 1: extra, 2: rejected
    int method = 1;
};

/// Soundings of a ping whose transmitter is 1.5 m below a water line 0.5 m above the reference
/// point: 1 m below that. Blocks have `more` bytes at their end that nobody knows.
inline std::string kmall_soundings(std::uint32_t seconds,
                                   const std::vector<MadeSounding>& soundings, int fan = 0,
                                   int more = 0) {
    const std::string unknown(static_cast<std::size_t>(more), '\x7f');
    const auto zeros = [](std::size_t count) { return std::string(count, '\0'); };
    MadeBytes out;
    out.u16(1).u16(1);  // one partition, the first
    out.u16(12 + more).u16(7).add<std::uint8_t>(2).add(static_cast<std::uint8_t>(fan));
    out.text += zeros(6) + unknown;
    MadeBytes info;
    info.text = zeros(144);
    info.at(0, static_cast<std::uint16_t>(144 + more)).at(20, 2e5F).at(24, 4e5F);
    info.at(92, std::uint16_t{2}).at(94, static_cast<std::uint16_t>(36 + more));
    info.at(100, 1500.0F).at(104, 1.5F).at(108, -0.5F);
    out.text += info.text + unknown;
    for (int sector = 0; sector < 2; ++sector)
        out.text += zeros(36) + unknown;
    MadeBytes receiver;
    receiver.text = zeros(32);
    receiver.at(0, static_cast<std::uint16_t>(32 + more));
    receiver.at(2, static_cast<std::uint16_t>(soundings.size()));
    receiver.at(6, static_cast<std::uint16_t>(120 + more)).at(28, std::uint16_t{3});
    receiver.at(30, std::uint16_t{4});
    out.text += receiver.text + unknown + zeros(3 * 4);
    for (const MadeSounding& own : soundings) {
        MadeBytes entry;
        entry.text = zeros(120);
        entry.at(3, static_cast<std::uint8_t>(own.type));
        entry.at(4, static_cast<std::uint8_t>(own.method));
        entry.at(52, static_cast<float>(own.level_db)).at(80, static_cast<float>(own.two_way_s));
        entry.at(96, static_cast<float>(own.below_m)).at(100, static_cast<float>(own.across_m));
        out.text += entry.text + unknown;
    }
    return kmall_datagram("#MRZ", seconds, out.text);
}

/// A datagram of a .all: from the 23rd of October 2004, one second past midnight.
inline std::string all_datagram(char type, int counter, int serial, const std::string& content,
                                bool big_endian = false) {
    MadeBytes out(big_endian);
    out.add('\x02').add(type).u16(3002).u32(20041023).u32(1000).u16(counter).u16(serial);
    out.text += content;
    out.add('\x03').u16(0);
    MadeBytes whole(big_endian);
    whole.u32(static_cast<std::uint32_t>(out.text.size()));
    return whole.text + out.text;
}

/// Water column of a .all, of beams whose ping has `all` of them.
inline std::string all_water(int counter, const std::vector<MadeBeam>& beams, int all,
                             int serial = 7, bool big_endian = false) {
    MadeBytes out(big_endian);
    out.u16(1).u16(1).u16(2).u16(all).u16(static_cast<int>(beams.size()));
    out.u16(14850).u32(1500000).u16(0).add<std::uint8_t>(30).add<std::int8_t>(-3).u32(0);
    for (int sector = 0; sector < 2; ++sector)
        out.u16(0).u16(29300).add(static_cast<std::uint8_t>(sector)).add<std::uint8_t>(0);
    for (const MadeBeam& beam : beams) {
        out.add(static_cast<std::int16_t>(std::lround(100.0 * beam.angle_deg))).u16(beam.first);
        out.u16(static_cast<int>(beam.levels.size())).u16(0).u16(0);
        for (const int level : beam.levels)
            out.add(static_cast<std::int8_t>(level));
    }
    return all_datagram('k', counter, serial, out.text, big_endian);
}

/// A record of XTF with a multibeam's soundings: travel time, angle and intensity of each.
inline std::string xtf_multibeam(const std::vector<std::array<double, 3>>& beams,
                                 double sound_speed_m_s) {
    MadeBytes out;
    out.text.assign(256, '\0');
    out.at(0, std::uint16_t{0xFACE}).at(2, std::uint8_t{28});
    out.at(4, static_cast<std::uint16_t>(beams.size()));
    out.at(10, static_cast<std::uint32_t>(256 + 64 * beams.size()));
    // 1970-01-02, 00:00:03 and a quarter of a second.
    out.at(14, std::uint16_t{1970}).at(16, std::uint8_t{1}).at(17, std::uint8_t{2});
    out.at(20, std::uint8_t{3}).at(21, std::uint8_t{25});
    out.at(72, static_cast<float>(sound_speed_m_s));
    for (const std::array<double, 3>& beam : beams)
        out.u32(1).add(beam[2]).u32(0).add(beam[0]).add(0.0).add(beam[1]).add(0.0).add(0.0).add(
            0.0);
    return out.text;
}

/// A DIDSON file of 48 beams: `frames` of counted samples, at `start` periods of delay.
inline std::string didson_file(int version, std::uint32_t frames, std::uint32_t samples,
                               std::uint32_t serial = 100, std::uint32_t start = 4) {
    constexpr std::uint32_t beams = 48;
    const std::uint32_t mark = 0x00464444U + (static_cast<std::uint32_t>(version) << 24U);
    MadeBytes out;
    out.text.assign(version == 3 ? 512 : 1024, '\0');
    out.at(0, mark).at(12, std::uint32_t{1}).at(16, beams).at(20, 50000.0F).at(24, samples);
    out.at(44, serial);
    for (std::uint32_t k = 0; k < frames; ++k) {
        const std::size_t frame = out.text.size();
        out.text.append(version == 3 ? 256 : 1024, '\0');
        // 1970-01-02, 00:00:0k and a quarter of a second.
        const std::uint32_t date[] = {1970, 1, 2, 0, 0, k, 25};
        for (std::size_t d = 0; d < 7; ++d)
            out.at(frame + 20 + 4 * d, date[d]);
        out.at(frame + 12, mark).at(frame + 52, start);
        for (std::uint32_t v = 0; v < samples * beams; ++v)
            out.add(static_cast<std::uint8_t>(v + k));
    }
    return out.text;
}

/// An ARIS file of 48 beams: `frames` of counted samples.
inline std::string aris_file(std::uint32_t frames, std::uint32_t samples,
                             std::uint32_t ordered = 1) {
    constexpr std::uint32_t beams = 48;
    MadeBytes out;
    out.text.assign(1024, '\0');
    out.at(0, std::uint32_t{0x05464444}).at(4, frames).at(16, beams).at(24, samples);
    for (std::uint32_t k = 0; k < frames; ++k) {
        const std::size_t frame = out.text.size();
        out.text.append(1024, '\0');
        out.at(frame, k).at(frame + 12, std::uint32_t{0x05464444});
        out.at(frame + 20, std::uint64_t{2000000} * (k + 1));
        out.at(frame + 452, std::uint32_t{8}).at(frame + 464, 1450.0F).at(frame + 468, samples);
        out.at(frame + 476, std::uint32_t{1000}).at(frame + 516, ordered);
        for (std::uint32_t v = 0; v < samples * beams; ++v)
            out.add(static_cast<std::uint8_t>(v + k));
    }
    return out.text;
}

/// A message of a Ping360 at a head angle in gradians: 2300, or 2301 with the range of the scan.
inline std::string ping360_message(int angle, const std::vector<int>& samples, bool is_auto) {
    MadeBytes payload;
    payload.add<std::uint8_t>(1).add<std::uint8_t>(0).u16(angle).u16(11).u16(800).u16(750);
    if (is_auto) payload.u16(0).u16(399).add<std::uint8_t>(1).add<std::uint8_t>(0);
    payload.u16(static_cast<int>(samples.size())).u16(static_cast<int>(samples.size()));
    for (const int sample : samples)
        payload.add(static_cast<std::uint8_t>(sample));
    MadeBytes out;
    out.text = "BR";
    out.u16(static_cast<int>(payload.text.size())).u16(is_auto ? 2301 : 2300).u16(0);
    out.text += payload.text;
    int sum = 0;
    for (const char byte : out.text)
        sum += static_cast<unsigned char>(byte);
    return out.u16(sum & 0xFFFF).text;
}

}  // namespace sonarsim::test
