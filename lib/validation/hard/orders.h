#pragma once

#include <string>
#include <vector>

namespace sonarsim {

/// The convergence of an engine's error with its resolution.
struct ConvergenceOrder {
    std::string scene;  ///< smooth, edgy or grazing
    std::string engine;
    std::string step;  ///< refined quantity: the error goal of the rays, the leaf of the octree
    std::vector<double> steps;
    std::vector<double> errors;  ///< relative L1 against the reference, one per step
    double order = 0.0;          ///< p of error ~ step^p, by least squares
};

/// Measured on images of an imaging sonar. Ray spacing along a beam is proportional to the error
/// goal, and the permitted range uncertainty between two rays to its power of 3/2; ray spacing
/// across a beam is the same for all goals. For the octree the step is the leaf.
std::vector<ConvergenceOrder> convergence_orders();

std::string orders_table(const std::vector<ConvergenceOrder>& orders);

}  // namespace sonarsim
