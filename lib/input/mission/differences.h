#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The keys in which two missions differ, for messages: " (seed: 7 there, 8 here; and 2 more)",
/// with the first few of them. "" if they do not differ, or if one is not YAML.
std::string differing_keys(std::string_view there, std::string_view here);

}  // namespace sonarsim
