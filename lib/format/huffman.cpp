#include "format/huffman.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sonarsim {

namespace {

/// A symbol, or two joined nodes.
struct Node {
    std::uint64_t count;
    std::size_t symbol;
    std::size_t parent = 0;
    std::uint8_t depth = 0;
};

/// The depth of each symbol in the Huffman tree of its counts; 0 if it does not occur.
std::vector<std::uint8_t> tree_depths(std::span<const std::uint32_t> counts) {
    std::vector<Node> nodes;
    nodes.reserve(2 * counts.size());
    for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
        if (counts[symbol] > 0) nodes.push_back({counts[symbol], symbol});
    }
    std::ranges::stable_sort(nodes, {}, &Node::count);
    // Joined nodes come in ascending order, so the rarest node is at the front of one of two queues.
    const std::size_t symbols = nodes.size();
    std::size_t next_symbol = 0;
    std::size_t next_joined = symbols;
    const auto join_rarest = [&](std::size_t parent) {
        const bool is_symbol =
            next_symbol < symbols && (next_joined >= nodes.size() ||
                                      nodes[next_symbol].count <= nodes[next_joined].count);
        Node& node = nodes[is_symbol ? next_symbol++ : next_joined++];
        node.parent = parent;
        return node.count;
    };
    for (std::size_t parent = symbols; parent + 1 < 2 * symbols; ++parent) {
        const std::uint64_t first = join_rarest(parent);
        nodes.push_back({first + join_rarest(parent), 0});
    }
    std::vector<std::uint8_t> depths(counts.size(), 0);
    for (std::size_t k = nodes.size(); k-- > 0;) {
        if (k + 1 < nodes.size())
            nodes[k].depth = static_cast<std::uint8_t>(nodes[nodes[k].parent].depth + 1);
        if (k < symbols) depths[nodes[k].symbol] = std::max<std::uint8_t>(nodes[k].depth, 1);
    }
    return depths;
}

}  // namespace

std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint32_t> counts, int longest) {
    // Halved counts give a flatter tree; with equal counts it is within every limit used here.
    std::vector<std::uint32_t> flatter(counts.begin(), counts.end());
    std::vector<std::uint8_t> lengths = tree_depths(flatter);
    while (*std::ranges::max_element(lengths) > longest) {
        for (std::uint32_t& count : flatter)
            count = (count + 1) / 2;
        lengths = tree_depths(flatter);
    }
    return lengths;
}

std::vector<std::uint16_t> huffman_codes(std::span<const std::uint8_t> lengths) {
    std::array<std::uint16_t, 16> next{};
    for (const std::uint8_t length : lengths) {
        if (length > 0 && length < 15) ++next[length + 1];
    }
    for (std::size_t bits = 1; bits < next.size(); ++bits)
        next[bits] = static_cast<std::uint16_t>(2 * (next[bits - 1] + next[bits]));
    std::vector<std::uint16_t> codes(lengths.size(), 0);
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        if (lengths[k] == 0) continue;
        std::uint16_t code = next[lengths[k]]++;
        for (int bit = 0; bit < lengths[k]; ++bit, code >>= 1)
            codes[k] = static_cast<std::uint16_t>(2 * codes[k] + (code & 1));
    }
    return codes;
}

}  // namespace sonarsim
