#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The Content-Security-Policy of a page with one <style> and one <script>. It permits these two,
/// by their hashes, and pictures from the folder of the page. Nothing else that a dataset brings
/// into the page runs, and nothing is loaded from elsewhere.
std::string content_policy(std::string_view page);

}  // namespace sonarsim
