#pragma once

#include <string_view>

namespace sonarsim {

// The files page.* of this folder, as they were when the program was built.

std::string_view page_html();
std::string_view page_css();
std::string_view page_js();

}  // namespace sonarsim
