#pragma once

#include <nlohmann/json.hpp>

#include "export/format.h"

namespace sonarsim {

/// The objects of a picture as lists with an entry per object, as detectors of Hugging Face read
/// them: `id` of the instance, `bbox` [left, top, width, height] and `area` in pixels,
/// `categories`, the number of the class from 0 on.
inline nlohmann::ordered_json objects_json(const ExportedPicture& picture) {
    using Json = nlohmann::ordered_json;
    Json json = {{"id", Json::array()},
                 {"bbox", Json::array()},
                 {"area", Json::array()},
                 {"categories", Json::array()}};
    for (const SourceObject& object : picture.objects) {
        const ObjectMask& mask = object.mask;
        json["id"].push_back(mask.id);
        const PixelBox& box = object.box;
        json["bbox"].push_back(Json{box.left, box.top, box.right - box.left, box.bottom - box.top});
        json["area"].push_back(mask.area);
        json["categories"].push_back(object.class_number - 1);
    }
    return json;
}

}  // namespace sonarsim
