#pragma once

#include <memory>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// The engine of a mission, over the trees that its assembly has made. The assembly must outlive
/// it.
std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly);

}  // namespace sonarsim
