#pragma once

#include <string>
#include <vector>

namespace sonarsim {

/// A key of a preset with its value and the comment that names its source.
struct PresetValue {
    std::string key;  ///< as "instrument.receiver.gamma"
    std::string value;
    std::string comment;
};

/// The text of a preset with other values. Lines that do not change keep their comments. Keys that
/// it lacks are added at the head of their section. InputError for a section that is not written in
/// lines of its own (`receiver: {...}`).
std::string with_values(const std::string& preset, const std::string& name,
                        const std::vector<PresetValue>& values);

}  // namespace sonarsim
