#pragma once

#include <string>
#include <vector>

#include "mission/reference.h"

namespace sonarsim {

/// Makes a Markdown table per section: key, type and unit, default, range, meaning.
std::string reference_markdown(const std::vector<SectionReference>& sections);

}  // namespace sonarsim
