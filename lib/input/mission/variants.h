#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input/mission/mission.h"
#include "input/mission/parse.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// The variants of a mission: missions with the keys of `vary` drawn. Rules that are drawn for
/// every ping are kept. The seed of a variant is a function of the mission's seed and the variant's
/// index. A draw is a function of the seed, the index of its rule in `vary` and the variant's
/// index. Thus a variant does not depend on the number of variants. Mission::variant holds the
/// drawn values. Each variant has a folder of its own in the mission's output folder. A variant is
/// made when it is taken, since a job may have 100,000. Throws InputError at the place in `vary`
/// for a key or a value that the mission does not accept.
class Variants {
  public:
    Variants() = default;
    Variants(const Mission& mission, const MissionSource& source, SonarKeyTable sonars);

    int size() const { return mission_.variants; }
    Mission operator[](int index) const { return make(index, draw_values(index)); }
    std::uint64_t seed(int index) const;
    /// Mission::variant.drawn of a variant that need not be made.
    DrawnValues drawn(int index) const;

    /// Missions that show which objects the variants may have: the first variant with each choice,
    /// and with each largest whole number, of the rules that vary the scene or the classes.
    std::vector<Mission> extremes() const;
    /// Notes the classes and instances of all choices for every variant that is made.
    void note(PossibleObjects objects) { objects_ = std::move(objects); }

  private:
    std::vector<std::string> draw_values(int index) const;
    Mission make(int index, const std::vector<std::string>& values) const;
    Mission parsed(const YamlNode& root) const;
    YamlNode resolved(const YamlNode& root) const;
    DrawnValues drawn_of(const std::vector<std::string>& values) const;
    void set_drawn(YamlNode& root, const DrawnValues& drawn) const;

    Mission mission_;
    MissionSource source_;
    SonarKeyTable sonars_;
    YamlNode whole_;
    /// The rules of `vary` that are not drawn for pings, those with `scale` last.
    std::vector<std::size_t> order_;
    /// The values that rules with `scale` multiply; empty if another rule may change them.
    std::optional<YamlNode> own_;
    PossibleObjects objects_;
};

/// The name of a variant's folder, "variant_0017".
std::string variant_folder(int index);

}  // namespace sonarsim
