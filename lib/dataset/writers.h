#pragma once

#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// The writers of one sensor, in the order in which a ping is written.
using Writers = std::vector<Writer>;

/// The writers of each sensor. InputError for the label `fan` without a fan.
std::vector<Writers> make_writers(const Mission& mission, const Assembly& assembly);

/// The writers of a sensor's raw values and labels alone; empty if the mission asks for neither.
Writers make_array_writers(const WriterContext& context);

/// The number of pings of each sensor.
std::vector<std::size_t> count_pings(const Mission& mission, std::size_t poses);

/// The room that a file takes on the disk, which has blocks of 4096 bytes.
double on_disk(double bytes);

/// The largest size of a sensor's files on the disk, bytes.
double bytes_at_most(const Writers& writers, std::size_t pings);

}  // namespace sonarsim
