#pragma once

#include <string>

namespace sonarsim {

/// The keys of a mission that a figure follows first, "instrument.receiver.noise_db, ..."; the keys
/// are those of a sensor but for `scene`.
std::string keys_behind(const std::string& figure);

}  // namespace sonarsim
