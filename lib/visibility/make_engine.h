#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "visibility/auto_engine.h"
#include "visibility/engine.h"
#include "visibility/octree/octree_engine.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim {

enum class EngineType { automatic, rays, octree, slices };

struct EngineSettings {
    EngineType type = EngineType::rays;
    OctreeOptions octree;            ///< read by the octree alone
    SlicesOptions slices = {};       ///< read by the slices alone
    std::vector<Probe> probes = {};  ///< read by `automatic` alone; without, it takes the slices
};

/// The engine over a scene that must outlive it. Throws InputError when octree.leaf_m is too small
/// for the scene, and std::runtime_error when memory does not suffice.
std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings);

/// Why the engine cannot hold this scene, as a sentence that begins with the mission's key; empty
/// when it can.
std::string refusal_of(const EngineSettings& settings, const Scene& scene);

/// Why the engine cannot see this view, as a sentence that names the mission's keys; empty when it
/// can.
std::string refusal_of(const EngineSettings& settings, const View& view);

/// Why the images of this view, with `multipath` or without, and with the mean of echoes over a bin
/// or their sum (`energies_add`), will probably be off by more than its error goal, in a sentence
/// that names the mission's keys; empty when they should meet it.
std::string doubt_about(const EngineSettings& settings, const View& view, bool multipath = false,
                        bool energies_add = false);

}  // namespace sonarsim
