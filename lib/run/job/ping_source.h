#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "output/dataset/writer.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A ping in memory, with the values that its files would hold.
struct PingInMemory {
    struct Array {
        std::string name;
        PingNumbers numbers;
    };
    struct Text {
        std::string name;
        std::string extension;  ///< ".json" or ".txt"
        std::string text;
    };

    PingNumbers image;          ///< float32: polar/ [range, azimuth], or the record of the kind
    std::vector<Array> arrays;  ///< raw values and labels, by the names of their files
    std::vector<Text> texts;    ///< labels that are text
    std::string metadata;       ///< meta/NNNNNN.json
};

/// The pings of a mission without files. They equal those of run_job(), and do not depend on which
/// other pings are requested.
class PingSource {
  public:
    /// `assembly` is that of the mission.
    PingSource(Mission mission, Assembly assembly);
    PingSource(const PingSource&) = delete;
    PingSource& operator=(const PingSource&) = delete;

    const Mission& mission() const { return mission_; }
    const Assembly& assembly() const { return assembly_; }

    /// Any number of threads may call it at a time. The id must be one of list_pings().
    /// std::runtime_error as brightest_pixel().
    PingInMemory ping(const PingId& id) const;

    /// dataset.json of the dataset that run_job() would begin. InputError as make_writers().
    nlohmann::ordered_json describe() const;

  private:
    Mission mission_;
    Assembly assembly_;
    std::unique_ptr<VisibilityEngine> engine_;
    std::vector<LabelPlan> plans_;  ///< in the order of the sensors
    std::vector<Writers> writers_;  ///< the same for raw values and labels
};

}  // namespace sonarsim
