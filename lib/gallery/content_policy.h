#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The Content-Security-Policy of a page with one <style> and one <script>. It permits these two,
/// known by their sums, and pictures from the folder of the page. Whatever a dataset may bring into
/// the page, nothing else runs, and nothing is loaded from elsewhere.
std::string content_policy(std::string_view page);

}  // namespace sonarsim
