#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/made_bytes.h"

namespace sonarsim::test {

/// A datagram of Simrad's .raw: type and time, then content.
inline std::string simrad_datagram(const char* type, const std::string& content) {
    MadeBytes out;
    out.text = type;
    // 1970-01-01 00:00:10 in 100 ns since 1601.
    out.add<std::uint64_t>((11644473600ULL + 10ULL) * 10000000ULL);
    out.text += content;
    MadeBytes whole;
    whole.u32(static_cast<std::uint32_t>(out.text.size()));
    whole.text += out.text;
    return whole.u32(static_cast<std::uint32_t>(out.text.size())).text;
}

/// A RAW0 datagram of power, or of angles alone.
inline std::string ek60_ping(double frequency_hz, const std::vector<int>& steps,
                             bool has_power = true) {
    MadeBytes out;
    out.u16(1).u16(has_power ? 3 : 2).f32(0.0).f32(frequency_hz);
    out.f32(1000.0).f32(1e-3).f32(2425.0).f32(2e-4).f32(1480.0).f32(0.01);
    out.text += std::string(76 - 48, '\0');
    out.add<std::int32_t>(2).add(static_cast<std::int32_t>(steps.size()));
    for (const int step : steps) {
        if (has_power) out.add(static_cast<std::int16_t>(step));
    }
    out.text += std::string(2 * steps.size(), '\x22');
    return simrad_datagram("RAW0", out.text);
}

/// A FIL1 datagram: a filter of a channel's receiver, with taps of real and imaginary parts.
inline std::string ek80_filter(const std::string& channel, int stage, int decimation,
                               const std::vector<double>& taps) {
    MadeBytes out;
    out.u16(stage).u16(0);
    out.text += channel + std::string(128 - channel.size(), '\0');
    out.u16(static_cast<int>(taps.size() / 2)).u16(decimation);
    for (const double part : taps)
        out.f32(part);
    return simrad_datagram("FIL1", out.text);
}

/// The XML datagrams before the pings of an EK80, with one receiver of 1,000 ohms.
inline std::string ek80_head() {
    return simrad_datagram(
               "XML0",
               "<Configuration><Transceivers><Transceiver Impedance=\"1000\"><Channels>"
               "<Channel ChannelID=\"A\" ChannelIdShort=\"a\" PulseDuration=\"1E-3;2E-3\"/>"
               "</Channels></Transceiver></Transceivers></Configuration>") +
           ek80_filter("A", 1, 1, {1.0, 0.0}) +
           simrad_datagram("XML0", "<Environment Depth=\"1\"\n SoundSpeed=\"1480.5\"/>");
}

/// The parameters of a channel's next pings; `form` 0 is a pulse that does not sweep.
inline std::string ek80_parameter(const std::string& channel, const std::string& frequency,
                                  int form = 0, const std::string& interval = "2.0E-04") {
    return simrad_datagram("XML0", "<Parameter><Channel ChannelID=\"" + channel +
                                       "\" PulseForm=\"" + std::to_string(form) + "\" " +
                                       frequency + " SampleInterval=\"" + interval +
                                       "\"/></Parameter>");
}

/// A RAW3 datagram with these samples, which have `count` of them.
inline std::string ek80_ping(const std::string& channel, int type, int count,
                             const std::string& samples) {
    MadeBytes out;
    out.text = channel + std::string(128 - channel.size(), '\0');
    out.u16(type).u16(0).add<std::int32_t>(2).add<std::int32_t>(count);
    return simrad_datagram("RAW3", out.text + samples);
}

}  // namespace sonarsim::test
