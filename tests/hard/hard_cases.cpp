// build-release/tests/hard_cases [NAME]: runs the hard cases, or those with NAME in their name, and
// prints them as a table. Exit code 1 where one fails.

#include <cstdio>

#include "hard/cases.h"

int main(int argc, char** argv) {
    using namespace sonarsim;
    const std::string name = argc > 1 ? argv[1] : "";
    std::vector<HardResult> results;
    bool all_hold = true;
    for (const HardCase& hard : hard_cases()) {
        if (hard.name.find(name) == std::string::npos) continue;
        std::fprintf(stderr, "%s\n", hard.name.c_str());
        for (HardResult& result : run_hard_case(hard)) {
            all_hold = all_hold && (result.holds() || !result.known_fault.empty());
            results.push_back(std::move(result));
        }
    }
    std::fputs(hard_table(results).c_str(), stdout);
    return all_hold && !results.empty() ? 0 : 1;
}
