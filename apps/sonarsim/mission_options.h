#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "input/mission/variants.h"

namespace sonarsim {

/// Options that render, validate and preview share: the mission and changes to it.
struct MissionOptions {
    std::filesystem::path file;
    std::vector<std::string> settings;
    std::string seed;
    std::filesystem::path out;
    std::filesystem::path paths_from;  ///< start of relative paths; empty: the mission's folder
};

/// The output of a command: the dataset, with --out for its folder, or something else.
enum class MissionOutput { dataset, other };

void add_mission_options(CLI::App& command, MissionOptions& options,
                         MissionOutput output = MissionOutput::dataset);

/// Adds -j.
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& meaning = "Threads (default: one per core)");

/// Loads the mission and applies --set, --seed and --out, in this order. Throws InputError as
/// load_mission() does, and when the mission is from a dataset and --paths-from is missing.
Mission load(const MissionOptions& options);

/// The variants of that mission; empty if it has none.
Variants load_variants(const MissionOptions& options, const Mission& mission);

/// Options that inspect and new share: how a mesh is read; "": not given.
struct MeshOptions {
    std::string units, up;

    MeshConfig config() const;
};

/// `usual` says what is taken without --units and --up.
void add_mesh_options(CLI::App& command, MeshOptions& options, const std::string& usual_units,
                      const std::string& usual_up);

}  // namespace sonarsim
