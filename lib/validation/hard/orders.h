#pragma once

#include <string>
#include <vector>

namespace sonarsim {

/// How the error of an engine falls as its resolution rises.
struct ConvergenceOrder {
    std::string scene;  ///< smooth, edgy or grazing
    std::string engine;
    std::string step;  ///< what is refined: the error goal of the rays, the leaf of the octree
    std::vector<double> steps;
    std::vector<double> errors;  ///< relative L1 against the reference, one per step
    double order = 0.0;          ///< p of error ~ step^p, by least squares
};

/// Images of an imaging sonar. Ray spacing along a beam is proportional to the error goal, and what
/// may be at stake between two rays to its power of 3/2; across a beam it is the same for all
/// goals. A leaf is its own step.
std::vector<ConvergenceOrder> convergence_orders();

std::string orders_table(const std::vector<ConvergenceOrder>& orders);

}  // namespace sonarsim
