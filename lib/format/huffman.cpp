#include "format/huffman.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sonarsim {

namespace {

/// A symbol, or two joined nodes.
struct Node {
    std::uint64_t count;
    int left;   ///< -1 in a symbol
    int right;  ///< the number of a symbol
};

/// The nodes of the tree; each node comes after its children.
std::vector<Node> tree_of(std::span<const std::uint32_t> counts) {
    // Sorted by count and symbol.
    std::vector<std::uint64_t> sorted;
    for (std::uint64_t symbol = 0; symbol < counts.size(); ++symbol) {
        if (counts[symbol] > 0) sorted.push_back(std::uint64_t{counts[symbol]} << 32 | symbol);
    }
    std::ranges::sort(sorted);
    std::vector<Node> nodes;
    nodes.reserve(2 * sorted.size());
    for (const std::uint64_t entry : sorted)
        nodes.push_back({entry >> 32, -1, static_cast<int>(entry)});
    // Joined nodes are created in ascending order, so that the rarest node is at the front of one
    // of two queues: symbols and joined nodes.
    const std::size_t symbols = nodes.size();
    std::size_t symbol = 0;
    std::size_t joined = symbols;
    const auto take = [&] {
        const bool from_symbols = symbol < symbols && (joined >= nodes.size() ||
                                                       nodes[symbol].count <= nodes[joined].count);
        return static_cast<int>(from_symbols ? symbol++ : joined++);
    };
    for (std::size_t k = 1; k < symbols; ++k) {
        const int left = take();
        const int right = take();
        nodes.push_back({nodes[left].count + nodes[right].count, left, right});
    }
    return nodes;
}

std::vector<std::uint8_t> lengths_in(const std::vector<Node>& nodes, std::size_t symbols) {
    std::vector<std::uint8_t> lengths(symbols, 0);
    std::vector<std::uint8_t> depth(nodes.size(), 0);
    for (std::size_t k = nodes.size(); k-- > 0;) {
        const Node& node = nodes[k];
        if (node.left < 0) {
            lengths[node.right] = std::max<std::uint8_t>(depth[k], 1);
        } else {
            depth[node.left] = depth[node.right] = static_cast<std::uint8_t>(depth[k] + 1);
        }
    }
    return lengths;
}

}  // namespace

std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint32_t> counts, int longest) {
    // Halved counts give a flatter tree; with equal counts it is within every limit used here.
    std::vector<std::uint32_t> flatter(counts.begin(), counts.end());
    std::vector<std::uint8_t> lengths = lengths_in(tree_of(flatter), flatter.size());
    while (*std::ranges::max_element(lengths) > longest) {
        for (std::uint32_t& count : flatter)
            count = (count + 1) / 2;
        lengths = lengths_in(tree_of(flatter), flatter.size());
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
