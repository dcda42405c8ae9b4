#include <algorithm>

#include "input/mission/parse.h"
#include "input/mission/resolved.h"
#include "simulate/sonar/kinds.h"
#include "target.h"

// The input is a mission, followed by lines "--set ..." after the first zero byte, if any. Whatever
// is accepted must survive the way through the resolved mission.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace sonarsim;
    const std::string_view input = text_of(data, size);
    const std::size_t end = std::min(input.find('\0'), size);
    std::vector<std::string> overrides;
    for (std::size_t start = end + 1; start < size;) {
        const std::size_t stop = std::min(input.find('\n', start), size);
        overrides.emplace_back(input.substr(start, stop - start));
        start = stop + 1;
    }
    return read_or_refuse([&] {
        const Mission mission =
            parse_mission(input.substr(0, end), "f.yaml", "/base", overrides, sonar_keys());
        const std::string resolved = resolved_yaml(mission, sonar_keys());
        const Mission again = parse_mission(resolved, "f.yaml", "/other", {}, sonar_keys());
        require(resolved_yaml(again, sonar_keys()) == resolved);
    });
}
