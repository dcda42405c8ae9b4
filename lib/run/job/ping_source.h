#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "input/mission/mission.h"
#include "output/dataset/writer.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A ping in memory, with the values that its files would hold.
struct PingInMemory {
    PingNumbers image;  ///< float32: polar/ [range, azimuth], or the record of the kind
    /// Raw values and labels, by the names of their files.
    std::vector<std::pair<std::string, PingNumbers>> arrays;
    /// Labels that are text: the name of the file, its extension and the text.
    std::vector<std::tuple<std::string, std::string, std::string>> texts;
    std::string metadata;  ///< meta/NNNNNN.json
};

/// The pings of a mission without files: those of run_job(), whichever pings are requested.
class PingSource {
  public:
    /// `assembled` is that of the mission, which must outlive it.
    PingSource(const Mission& of, Assembly assembled);
    PingSource(const PingSource&) = delete;
    PingSource& operator=(const PingSource&) = delete;

    /// For any thread; the id is one of list_pings(). std::runtime_error as brightest_pixel().
    PingInMemory ping(const PingId& id) const;

    /// dataset.json of the dataset that run_job() would begin. InputError as make_writers().
    std::string describe() const;

    const Mission& mission;
    const Assembly assembly;

  private:
    std::unique_ptr<VisibilityEngine> engine_;
    std::vector<LabelPlan> plans_;  ///< in the order of the sensors
    std::vector<Writers> writers_;  ///< the same for raw values and labels
};

}  // namespace sonarsim
