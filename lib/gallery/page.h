#pragma once

#include <string_view>

namespace sonarsim {

// The files in page/, all scripts as one, as they were when the program was built.

std::string_view page_html();
std::string_view page_css();
std::string_view page_js();

}  // namespace sonarsim
