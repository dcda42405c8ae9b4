#include "format/huffman.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sonarsim {

namespace {

/// A symbol, or two nodes joined.
struct Node {
    std::uint64_t count;
    int left;   ///< -1: a symbol
    int right;  ///< or the number of the symbol
};

/// The nodes of the tree; a node comes after those below it.
std::vector<Node> tree_of(std::span<const std::uint32_t> counts) {
    std::vector<Node> nodes;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        if (counts[k] > 0) nodes.push_back({counts[k], -1, static_cast<int>(k)});
    }
    std::ranges::stable_sort(nodes, {}, &Node::count);
    // Joined nodes come out in ascending order, too: the next one is at the front of either queue.
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
    // Flatter counts make a flatter tree; that of equal counts is within every limit used here.
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
