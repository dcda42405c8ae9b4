#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/text.h"
#include "format/byte_fields.h"
#include "format/ek80_pulse.h"
#include "format/ek_log.h"

namespace sonarsim {

namespace {

// Simrad, "EK80 Interface specifications": datagrams like those of an EK60. XML0 has the
// environment and, before a ping, its parameters; RAW3 has its samples, FIL1 a filter of a
// channel's receiver. Offsets count from the end of the first length.
constexpr std::size_t channel_at = 12, channel_length = 128, type_at = 140, offset_at = 144,
                      count_at = 148, raw3_data = 152;
constexpr std::size_t stage_at = 12, filter_channel_at = 16, tap_count_at = 144,
                      decimation_at = 146, taps_at = 148;
constexpr unsigned power_bit = 1, half_bit = 4, complex_bit = 8;
// The impedance of the receiver if the file has none, and that of a transducer, in ohms.
constexpr double usual_ohms = 5400.0, transducer_ohms = 75.0;
// A file with damaged settings may have another pulse in each ping; all pulses together take at
// most 256 MB.
constexpr std::size_t most_pulse_values = std::size_t{1} << 24;

struct Ek80Channel {
    double frequency_hz = 0.0;
    double sample_s = 0.0;
    bool is_sweep = false;
    EkSweep sweep;
    double ohms = usual_ohms;         ///< impedance of its receiver
    std::map<int, EkFilter> filters;  ///< stages by their numbers
    /// The sweep after these filters; null until a ping needs it.
    std::shared_ptr<const std::vector<std::complex<double>>> pulse;
};

/// The contents of the XML datagrams so far.
struct Ek80Settings {
    double sound_speed_m_s = 0.0;
    std::map<std::string, Ek80Channel, std::less<>> channels;
    std::size_t pulse_values = 0;  ///< number of values in all pulses so far
    std::size_t products = 0;      ///< number of products in their filters so far
};

/// The start tags of a name, without their brackets.
std::vector<std::string_view> xml_tags(std::string_view xml, const std::string& name) {
    std::vector<std::string_view> tags;
    for (std::size_t at = xml.find('<' + name); at != std::string_view::npos;
         at = xml.find('<' + name, at + 1)) {
        // A tag without an end stops at the next one.
        const std::string_view tag = xml.substr(at, xml.find_first_of("<>", at + 1) - at);
        const std::string_view after = tag.substr(name.size() + 1);
        if (!after.empty() && after.find_first_of(" \t\r\n") == 0) tags.push_back(after);
    }
    return tags;
}

/// The text of an attribute; empty if the tag lacks it.
std::string_view xml_attribute(std::string_view tag, const std::string& name) {
    const std::string wanted = name + "=\"";
    for (std::size_t at = tag.find(wanted); at != std::string_view::npos;
         at = tag.find(wanted, at + 1)) {
        if (at == 0 || std::string_view(" \t\r\n").find(tag[at - 1]) == std::string_view::npos)
            continue;
        const std::string_view text = tag.substr(at + wanted.size());
        return text.substr(0, text.find('"'));
    }
    return {};
}

std::string channel_id(std::string_view channel) {
    return std::string(xml_attribute(channel, "ChannelID"));
}

std::optional<double> xml_number(std::string_view tag, const std::string& name) {
    return parse_number(xml_attribute(tag, name));
}

/// Takes the impedances of the receivers from the configuration.
void take_receivers(std::string_view xml, Ek80Settings& settings) {
    constexpr std::string_view begin = "<Transceiver ";
    for (std::size_t at = xml.find(begin); at != std::string_view::npos;) {
        const std::size_t next = xml.find(begin, at + 1);
        const std::string_view own = xml.substr(at, next - at);
        const double ohms = xml_number(own.substr(0, own.find('>')), "Impedance").value_or(0.0);
        for (const std::string_view tag : xml_tags(own, "Channel")) {
            if (ohms > 0.0) settings.channels[channel_id(tag)].ohms = ohms;
        }
        at = next;
    }
}

void take_settings(std::string_view xml, Ek80Settings& settings) {
    for (const std::string_view tag : xml_tags(xml, "Environment"))
        settings.sound_speed_m_s = xml_number(tag, "SoundSpeed").value_or(0.0);
    take_receivers(xml, settings);
    for (const std::string_view tag : xml_tags(xml, "Channel")) {
        const auto interval = xml_number(tag, "SampleInterval");
        if (!interval) continue;  // the configuration has no ping's parameters
        const double start = xml_number(tag, "FrequencyStart").value_or(0.0);
        const double end = xml_number(tag, "FrequencyEnd").value_or(start);
        Ek80Channel& channel = settings.channels[channel_id(tag)];
        channel.sample_s = *interval;
        channel.frequency_hz = xml_number(tag, "Frequency").value_or(0.5 * (start + end));
        channel.is_sweep = xml_number(tag, "PulseForm").value_or(0.0) != 0.0;
        const auto length = xml_number(tag, "PulseLength");  // the name in older files
        const EkSweep sweep{start, end,
                            xml_number(tag, "PulseDuration").value_or(length.value_or(0)),
                            xml_number(tag, "Slope").value_or(0.0), *interval};
        if (sweep != channel.sweep) channel.pulse.reset();
        channel.sweep = sweep;
    }
}

std::string name_at(std::string_view datagram, std::size_t at) {
    const std::string_view field = datagram.substr(at, channel_length);
    return std::string(field.substr(0, field.find('\0')));
}

void take_filter(std::string_view datagram, Ek80Settings& settings) {
    if (datagram.size() < taps_at) throw std::runtime_error("has a FIL1 datagram that is cut off");
    EkFilter filter;
    filter.decimation = field_at<std::uint16_t>(datagram, decimation_at);
    const std::size_t count = field_at<std::uint16_t>(datagram, tap_count_at);
    for (std::size_t k = 0; k < count; ++k)
        filter.taps.emplace_back(field_at<float>(datagram, taps_at + 8 * k),
                                 field_at<float>(datagram, taps_at + 8 * k + 4));
    Ek80Channel& channel = settings.channels[name_at(datagram, filter_channel_at)];
    channel.filters[field_at<std::int16_t>(datagram, stage_at)] = std::move(filter);
    channel.pulse.reset();
}

/// Makes the pulse of a channel that sweeps, unless the channel has one.
void make_pulse(Ek80Channel& channel, Ek80Settings& settings) {
    if (!channel.is_sweep || channel.pulse) return;
    if (channel.filters.empty())
        throw std::runtime_error("has sweeps without their filters (FIL1 datagrams)");
    std::vector<EkFilter> filters;
    for (const auto& [stage, filter] : channel.filters)
        filters.push_back(filter);
    channel.pulse = std::make_shared<const std::vector<std::complex<double>>>(
        filtered_sweep(channel.sweep, filters, settings.products));
    settings.pulse_values += channel.pulse->size();
    if (settings.pulse_values > most_pulse_values)
        throw std::runtime_error("changes its sweeps too often; split the file");
}

/// Takes the samples of a RAW3 datagram, if they are power or complex.
void take_samples(std::string_view datagram, double ohms, EkPing& ping) {
    const auto type = static_cast<unsigned>(field_at<std::uint16_t>(datagram, type_at));
    ping.has_half_floats = (type & half_bit) != 0;
    const bool is_complex = (type & (half_bit | complex_bit)) != 0;
    if (!is_complex && (type & power_bit) == 0) return;
    const auto offset = field_at<std::int32_t>(datagram, offset_at);
    const auto count = field_at<std::int32_t>(datagram, count_at);
    ping.sectors = is_complex ? static_cast<int>((type >> 8U) & 7U) : 0;
    const std::size_t of_one = ping.has_half_floats ? 4 : 8;
    const std::size_t bytes = is_complex ? of_one * static_cast<std::size_t>(ping.sectors) : 2;
    if (offset < 0 || count < 0 || bytes == 0)
        throw std::runtime_error("has a ping with impossible numbers");
    ping.offset = static_cast<std::size_t>(offset);
    ping.count = static_cast<std::size_t>(count);
    if (ping.count > (datagram.size() - raw3_data) / bytes)
        throw std::runtime_error("has more samples than their datagram");
    ping.samples = datagram.substr(raw3_data, bytes * ping.count);
    // Andersen et al. 2021: P = N (|y| / (2 sqrt 2))^2 ((Zr + Zt) / Zr)^2 / Zt, y the mean of N.
    const double share = (ohms + transducer_ohms) / ohms;
    ping.watts = ping.sectors / 8.0 * share * share / transducer_ohms;
}

EkPing ek80_ping_of(std::string_view datagram, Ek80Settings& settings,
                    std::optional<double> wanted_hz) {
    field_at<std::int32_t>(datagram, count_at);  // throws where the datagram is too short
    const auto found = settings.channels.find(name_at(datagram, channel_at));
    if (found == settings.channels.end() || found->second.sample_s == 0.0)
        throw std::runtime_error("has a ping without its parameters (XML0 datagram)");
    EkPing ping;
    ping.t_s = ek_time_s(datagram);
    ping.frequency_hz = found->second.frequency_hz;
    ping.sample_s = found->second.sample_s;
    ping.sound_speed_m_s = settings.sound_speed_m_s;
    check_ek(ping);
    take_samples(datagram, found->second.ohms, ping);
    const bool is_read = !wanted_hz || is_wanted(ping.frequency_hz, *wanted_hz);
    if (is_read && ping.count > 0 && ping.sectors > 0) {
        make_pulse(found->second, settings);
        if (found->second.is_sweep) ping.pulse = found->second.pulse;
    }
    return ping;
}

}  // namespace

SonarLog read_ek80(std::string_view bytes, std::size_t most_pings,
                   std::optional<double> frequency_hz) {
    Ek80Settings settings;
    std::vector<EkPing> pings;
    for (const std::string_view datagram : ek_datagrams(bytes)) {
        if (datagram.starts_with("XML0")) take_settings(datagram.substr(12), settings);
        if (datagram.starts_with("FIL1")) take_filter(datagram, settings);
        if (!datagram.starts_with("RAW3")) continue;
        const EkPing ping = ek80_ping_of(datagram, settings, frequency_hz);
        if (ping.count > 0) pings.push_back(ping);
    }
    if (pings.empty())
        throw std::runtime_error("has no power or complex samples of an EK80 (RAW3 datagrams)");
    return log_of_ek(pings, most_pings, frequency_hz);
}

}  // namespace sonarsim
