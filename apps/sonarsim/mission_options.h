#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "mission/mission.h"

namespace sonarsim {

/// What render, validate and preview share: the mission and what changes it.
struct MissionOptions {
    std::filesystem::path file;
    std::vector<std::string> settings;
    std::string seed;
    std::filesystem::path out;
    std::filesystem::path
        paths_from;  ///< where relative paths start; empty: at the mission's folder
};

/// What a command makes of a mission: the dataset, with --out for its folder, or something else.
enum class MissionOutput { dataset, other };

void add_mission_options(CLI::App& command, MissionOptions& options,
                         MissionOutput output = MissionOutput::dataset);

/// The mission with --set, --seed and --out applied, in this order. InputError as load_mission, and
/// when the mission comes from a dataset and it is not said where its files are.
Mission load(const MissionOptions& options);

/// The variants of that mission; none where it has none.
std::vector<Mission> load_variants(const MissionOptions& options, const Mission& mission);

}  // namespace sonarsim
