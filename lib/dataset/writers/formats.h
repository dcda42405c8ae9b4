#pragma once

#include <memory>

#include "dataset/writer.h"

namespace sonarsim {

// One maker per format, in the file of its name; null when the mission does not ask for it or the
// sonar has no such output.

std::unique_ptr<Writer> make_polar_writer(const WriterContext& context);
std::unique_ptr<Writer> make_image_writer(const WriterContext& context);
std::unique_ptr<Writer> make_raw_writer(const WriterContext& context);
std::unique_ptr<Writer> make_raw_records_writer(const WriterContext& context);
std::unique_ptr<Writer> make_fan_writer(const WriterContext& context);
std::unique_ptr<Writer> make_stages_writer(const WriterContext& context);
std::unique_ptr<Writer> make_waterfall_writer(const WriterContext& context);
std::unique_ptr<Writer> make_echogram_writer(const WriterContext& context);
std::unique_ptr<Writer> make_soundings_writer(const WriterContext& context);
std::unique_ptr<Writer> make_scan_writer(const WriterContext& context);
std::unique_ptr<Writer> make_meta_writer(const WriterContext& context);

}  // namespace sonarsim
