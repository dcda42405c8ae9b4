#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sonarsim {

inline constexpr const char* of_another_mission = "of another mission";

/// The difference between two descriptions as the end of a sentence that begins with "a dataset":
/// "of another mission". Empty if both are the same dataset, complete or not. Their keys need not
/// be checked.
std::string difference_between(const nlohmann::ordered_json& found,
                               const nlohmann::ordered_json& expected);

}  // namespace sonarsim
