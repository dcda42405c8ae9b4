#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "mission/limits.h"

namespace sonarsim {

// The types of values in JSON Schema.

using SchemaJson = nlohmann::ordered_json;

/// Writes a whole number as 5, not as 5.0.
SchemaJson number_json(double value);

/// `true` and `false` among the names of a choice are flags.
SchemaJson choice_json(const std::string& name);

/// `type`: "number" or "integer".
SchemaJson within_limits(const char* type, const Limits& limits);

/// The reader accepts any scalar as text, even a number.
SchemaJson text_json();

SchemaJson list_json(SchemaJson items, std::size_t fewest);

SchemaJson numbers_json(std::size_t count, const Limits& limits);

/// Adds the keys of `own` that `all` lacks, and also those of the sections that both have: the beam
/// of a side-scan sonar has other keys than the beam of an imaging sonar.
void add_missing_keys(const SchemaJson& own, SchemaJson& all);

template <std::size_t N>
SchemaJson list_of(const std::array<double, N>& values) {
    SchemaJson list = SchemaJson::array();
    for (const double value : values)
        list.push_back(number_json(value));
    return list;
}

}  // namespace sonarsim
