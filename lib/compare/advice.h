#pragma once

#include <string>

namespace sonarsim {

/// The keys of a mission that affect a figure most, "instrument.receiver.noise_db, ...": keys of a
/// sensor, or of `scene`.
std::string keys_behind(const std::string& figure);

}  // namespace sonarsim
