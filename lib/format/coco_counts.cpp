#include "format/coco_counts.h"

namespace sonarsim {

std::string coco_counts(std::span<const std::uint32_t> runs) {
    std::string text;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        std::int64_t left = runs[k];
        if (k > 2) left -= runs[k - 2];
        bool more = true;
        while (more) {
            auto group = static_cast<char>(left & 0x1F);
            left >>= 5;
            // The fifth bit of the last group is the sign.
            more = (group & 0x10) != 0 ? left != -1 : left != 0;
            if (more) group |= 0x20;
            text += static_cast<char>(group + '0');
        }
    }
    return text;
}

}  // namespace sonarsim
