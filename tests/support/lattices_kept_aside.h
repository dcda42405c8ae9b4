#pragma once

#include <span>

#include "support/lattice_builder.h"

namespace sonarsim::test {

/// Shapes unlike those of lattices.cpp, for judging what was developed on those: louvres, grass,
/// springs, chains, perforated plates, trees, rubble, hull frames, urchins and crumpled sheets.
std::span<const LatticeShape> shapes_kept_aside();

}  // namespace sonarsim::test
