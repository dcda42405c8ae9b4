#include <algorithm>
#include <optional>
#include <span>

#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/folded_records.h"
#include "product/object_masks.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// An object that no ping shows for longer than this begins another pass.
constexpr std::size_t most_unseen = 32;

/// The picture that is made of all pings of a sensor. A row, or column, may stand for several.
struct RecordPicture {
    std::uint64_t id;
    std::size_t sensor;
    std::string file;  ///< relative to the folder of the dataset
    PingRecord ids;    ///< the records of instances
    bool is_upright;   ///< pings are columns
    std::size_t bins;  ///< per ping
    std::size_t rows;  ///< rows or columns of pings

    std::size_t width() const { return is_upright ? rows : bins; }
    std::size_t height() const { return is_upright ? bins : rows; }
};

std::optional<RecordPicture> picture_of(const SensorLayout& sensor, const Json& described) {
    const Json* const picture = labelled_picture(described, "sensor");
    const PingRecord* const ids = instance_record(sensor);
    if (!picture || !ids) return std::nullopt;
    const bool is_upright = ids->format.fortran_order;
    return RecordPicture{.id = 0,
                         .sensor = 0,
                         .file = picture->at("boxes_of"),
                         .ids = *ids,
                         .is_upright = is_upright,
                         .bins = ids->format.shape[is_upright ? 0 : 1],
                         .rows = static_cast<std::size_t>(picture_rows(sensor.pings))};
}

/// An object on its way past the sonar, and how often it has been passed.
struct Passing {
    std::uint16_t number = 0;  ///< number of its present pass
    std::size_t last = 0;      ///< ping that saw it
};

/// The passes of a picture by numbers from 1 on, in the order of object_masks(). Where a row stands
/// for several pings, the first of them that shows an object counts.
struct Passes {
    std::vector<std::uint16_t> of_pixel;
    std::vector<std::uint16_t> instance{0};  ///< indexed by the number of a pass
};

Passes passes_of(const RecordPicture& picture, const RecordFile& records) {
    const std::size_t pings = records.records();
    Passes out;
    out.of_pixel.resize(picture.bins * picture.rows);
    const std::size_t each = pings_per_row(pings);
    std::vector<Passing> passing(65536);
    std::vector<std::uint16_t> record(picture.bins);
    for (std::size_t ping = 0; ping < pings; ++ping) {
        records.read(ping, std::as_writable_bytes(std::span(record)));
        for (std::size_t bin = 0; bin < picture.bins; ++bin) {
            const std::uint16_t id = record[bin];
            if (id == 0) continue;
            Passing& one = passing[id];
            const bool is_new = one.number == 0 || ping - one.last > most_unseen;
            if (is_new && out.instance.size() < 65536) {
                one.number = static_cast<std::uint16_t>(out.instance.size());
                out.instance.push_back(id);
            }
            one.last = ping;
            const std::size_t row = ping / each;
            std::uint16_t& pixel = out.of_pixel[picture.is_upright ? row * picture.bins + bin
                                                                   : bin * picture.rows + row];
            if (pixel == 0) pixel = one.number;
        }
    }
    return out;
}

}  // namespace

void write_record_coco(const Layout& layout, const Json& description,
                       const SharedProduct& product) {
    std::uint64_t id = 1;
    for (const SensorLayout& sensor : layout.sensors)
        id += 2 * sensor.pings;
    std::vector<RecordPicture> pictures;
    for (std::size_t i = 0; i < layout.sensors.size(); ++i, ++id) {
        if (auto picture = picture_of(layout.sensors[i], description.at("sensors").at(i))) {
            picture->id = id;
            picture->sensor = i;
            pictures.push_back(*std::move(picture));
        }
    }
    CocoFile out(layout.folder / product.file, description);
    out.begin_list("images");
    for (const RecordPicture& picture : pictures) {
        const SensorLayout& sensor = layout.sensors[picture.sensor];
        out.add({{"id", picture.id},
                 {"file_name", picture.file},
                 {"width", picture.width()},
                 {"height", picture.height()},
                 {"sensor", sensor.name}});
    }
    out.end_list();
    out.begin_list("annotations");
    const Json& instances = description.at("labels").at("instances");
    std::uint64_t annotation_id = id * ids_per_image;
    for (const RecordPicture& picture : pictures) {
        const std::size_t pings = layout.sensors[picture.sensor].pings;
        const RecordFile records(layout.sensor_folder(picture.sensor) / picture.ids.file,
                                 picture.ids.format, pings, RecordAccess::read);
        const Passes passes = passes_of(picture, records);
        for (const ObjectMask& mask :
             object_masks(passes.of_pixel, static_cast<int>(picture.height()))) {
            const std::uint16_t instance = passes.instance[mask.id];
            CocoAnnotation annotation = mask_annotation(mask, picture.width(), picture.height());
            annotation.id = annotation_id++;
            annotation.image_id = picture.id;
            annotation.instance = instance;
            annotation.category = instances.at(instance - 1).at("class");
            out.add(annotation_json(annotation));
        }
    }
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
