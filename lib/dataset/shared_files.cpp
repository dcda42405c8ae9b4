#include "dataset/shared_files.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/text.h"
#include "dataset/coco/coco.h"
#include "dataset/coco/statistics.h"
#include "dataset/shared_products.h"
#include "dataset/split.h"

namespace sonarsim {

namespace {

/// The pose numbers of a part of the split, one per line, as in the names of ping files.
std::string pose_list(const Layout& layout, SplitPart part,
                      const std::vector<SplitPart>& part_of_pose) {
    std::string text;
    for (std::uint32_t pose = 0; pose < part_of_pose.size(); ++pose) {
        if (part_of_pose[pose] == part) text += layout.number(pose) + '\n';
    }
    return text;
}

/// The names of the classes, one per line; YOLO numbers them 0, 1, ...
std::string class_list(const nlohmann::ordered_json& description) {
    std::string text;
    for (const auto& one : description.at("labels").at("classes"))
        text += printable(one.at("name").get<std::string>()) + '\n';
    return text;
}

/// True for a COCO file of the pictures of single pings.
bool shows_pings(const SharedProduct& product) {
    return product.kind == SharedProduct::Kind::coco &&
           (product.picture == CocoPicture::polar || product.picture == CocoPicture::fan);
}

}  // namespace

void write_shared_products(const Layout& layout, const Mission& mission,
                           const nlohmann::ordered_json& description) {
    const SplitConfig& split = mission.output.split;
    const std::vector<SplitPart> part_of_pose =
        split.is_on() ? split_poses(split, layout.poses)
                      : std::vector<SplitPart>(layout.poses, SplitPart::none);
    const std::vector<SharedProduct> products = shared_products(mission);
    std::vector<SharedProduct> of_pings;
    std::ranges::copy_if(products, std::back_inserter(of_pings), shows_pings);
    write_coco(layout, description, of_pings, part_of_pose);
    std::vector<std::string> coco_files;  // written so far
    for (const SharedProduct& product : products) {
        switch (product.kind) {
            case SharedProduct::Kind::coco:
                if (product.picture == CocoPicture::record) {
                    write_record_coco(layout, description, product);
                } else if (product.picture == CocoPicture::scan) {
                    write_scan_coco(layout, mission, description, product);
                }
                coco_files.push_back(product.file);
                break;
            case SharedProduct::Kind::class_names:
                write_file(layout.folder / product.file, class_list(description));
                break;
            case SharedProduct::Kind::split:
                write_file(layout.folder / product.file,
                           pose_list(layout, product.part, part_of_pose));
                break;
            case SharedProduct::Kind::initial:
                break;
            case SharedProduct::Kind::statistics:
                write_statistics(layout.folder, coco_files, false);
                break;
        }
    }
}

}  // namespace sonarsim
