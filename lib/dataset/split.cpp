#include "dataset/split.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "mission/dataset_names.h"

namespace sonarsim {

std::string split_file_of(std::string_view part) {
    return std::string(split_folder_name) + '/' + std::string(part) + ".txt";
}

double share_of(const SplitConfig& config, SplitPart part) {
    if (part == SplitPart::train) return config.train;
    if (part == SplitPart::val) return config.val;
    return part == SplitPart::test ? config.test : 0.0;
}

std::vector<SplitPart> parts_of(const SplitConfig& config) {
    std::vector<SplitPart> parts;
    for (const SplitPart part : {SplitPart::train, SplitPart::val, SplitPart::test}) {
        if (share_of(config, part) > 0.0) parts.push_back(part);
    }
    return parts;
}

namespace {

/// Splits `poses` poses or variants. A part may get none.
std::vector<SplitPart> split(const SplitConfig& config, std::size_t poses) {
    const std::vector<SplitPart> parts = parts_of(config);
    std::vector<SplitPart> of_pose(poses, SplitPart::none);
    std::vector<std::size_t> borders;
    const auto rounds = static_cast<std::size_t>(config.rounds);
    std::size_t begin = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        const auto from = static_cast<double>(poses * round / rounds);
        const auto length = static_cast<double>(poses * (round + 1) / rounds) - from;
        double share = 0.0;
        for (const SplitPart part : parts) {
            share += share_of(config, part);
            const bool last = part == parts.back();
            const auto end =
                static_cast<std::size_t>(std::llround(from + length * (last ? 1.0 : share)));
            std::fill(of_pose.begin() + static_cast<std::ptrdiff_t>(begin),
                      of_pose.begin() + static_cast<std::ptrdiff_t>(end), part);
            if (parts.size() > 1 && end < poses) borders.push_back(end);
            begin = end;
        }
    }
    for (const std::size_t border : borders) {
        const auto gap = static_cast<std::size_t>(config.gap);
        const std::size_t first = border - std::min(border, gap / 2);
        const std::size_t end = std::min(border + (gap - gap / 2), poses);
        std::fill(of_pose.begin() + static_cast<std::ptrdiff_t>(first),
                  of_pose.begin() + static_cast<std::ptrdiff_t>(end), SplitPart::none);
    }
    return of_pose;
}

}  // namespace

std::vector<SplitPart> split_poses(const SplitConfig& config, std::size_t poses) {
    std::vector<SplitPart> of_pose = split(config, poses);
    for (const SplitPart part : parts_of(config)) {
        if (std::ranges::find(of_pose, part) != of_pose.end()) continue;
        throw InputError(config.place.location,
                         "none of " + std::to_string(poses) + " poses is left for '" +
                             std::string(split_part_names[static_cast<std::size_t>(part)]) +
                             "': take a smaller gap, fewer rounds, or leave the part out");
    }
    return of_pose;
}

std::vector<SplitPart> split_variants(const SplitConfig& config, std::size_t variants) {
    const std::vector<SplitPart> parts = parts_of(config);
    if (variants < parts.size()) return std::vector(variants, parts.front());
    SplitConfig without_gap = config;
    without_gap.gap = 0;
    return split(without_gap, variants);
}

}  // namespace sonarsim
