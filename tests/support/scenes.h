#pragma once

#include "study/shapes.h"

namespace sonarsim::test {

using namespace shapes;

}  // namespace sonarsim::test
