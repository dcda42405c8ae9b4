#pragma once

#include <span>
#include <string>
#include <vector>

#include "dataset/layout.h"
#include "job/resume.h"

namespace sonarsim {

/// The output of each writer of a sensor for a ping, in their order: the bytes of a file or record.
using EncodedPing = std::vector<std::string>;

/// A ping for the journal. The references must outlive it.
struct PingToList {
    const SensorLayout& sensor;
    const EncodedPing& encoded;
};
/// The fields of each ping in the journal. The sums of several pings' files take less time
/// together.
std::vector<std::vector<std::string>> journal_fields(std::span<const PingToList> pings);

/// Reads a ping that is in a dataset. InputError when a file cannot be read; std::system_error when
/// the disk fails.
EncodedPing read_ping(const Layout& layout, const RecordFiles& records, const PingId& ping);

/// Writes the files and records of a ping where the layout says. From any thread, in any order.
/// std::system_error when the disk does not take it.
void write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                const EncodedPing& encoded);

}  // namespace sonarsim
