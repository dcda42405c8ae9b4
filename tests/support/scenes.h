#pragma once

#include "validation/shapes.h"

namespace sonarsim::test {

using namespace shapes;

}  // namespace sonarsim::test
