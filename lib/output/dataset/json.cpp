#include "output/dataset/json.h"

#include <cmath>

namespace sonarsim {

Json describe_box(const PixelBox& box) {
    return {{"x", {box.left, box.right}}, {"y", {box.top, box.bottom}}};
}

Json describe_pose(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return {{"position_m", describe_vector(pose.translation)},
            {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json rounded(const std::optional<double>& value, double parts) {
    if (!value) return nullptr;
    return std::round(*value * parts) / parts;
}

// The name of a mission or a file may be any bytes; what is no UTF-8 becomes U+FFFD.

std::string json_text(const Json& json) {
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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

std::string objects_text(const Json& head, const std::vector<Json>& objects) {
    std::string text = json_line(head);
    text.back() = ',';
    text += "\"objects\":[";
    for (std::size_t k = 0; k < objects.size(); ++k)
        text += (k == 0 ? "\n" : ",\n") + json_line(objects[k]);
    return text + "\n]}\n";
}

}  // namespace sonarsim
