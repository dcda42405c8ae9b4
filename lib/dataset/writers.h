#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

// One maker per format; null when the mission does not ask for it or the sonar has no such output.

std::unique_ptr<Writer> make_polar_writer(const WriterContext& context);
std::unique_ptr<Writer> make_image_writer(const WriterContext& context);
std::unique_ptr<Writer> make_fan_writer(const WriterContext& context);
std::unique_ptr<Writer> make_stages_writer(const WriterContext& context);
std::unique_ptr<Writer> make_waterfall_writer(const WriterContext& context);
std::unique_ptr<Writer> make_echogram_writer(const WriterContext& context);
std::unique_ptr<Writer> make_soundings_writer(const WriterContext& context);
std::unique_ptr<Writer> make_scan_writer(const WriterContext& context);
std::unique_ptr<Writer> make_meta_writer(const WriterContext& context);

/// The writers of one sensor, in the order in which a ping is written.
using Writers = std::vector<std::unique_ptr<Writer>>;

/// The outputs of a writer that leaves a record of `bytes` per ping in `file`.
WriterOutputs record_outputs(std::string file, NpyFormat format, nlohmann::ordered_json axes,
                             double bytes);

/// By sensor. InputError when a sensor of the mission would have no output at all.
std::vector<Writers> make_writers(const Mission& mission, const Assembly& assembly);

/// How many pings each sensor sends.
std::vector<std::size_t> count_pings(const Mission& mission, std::size_t poses);

/// The most that a sensor's files take, in bytes.
double bytes_at_most(const Writers& writers, std::size_t pings);

}  // namespace sonarsim
