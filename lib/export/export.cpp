#include "export/export.h"

#include <set>
#include <stdexcept>

#include "core/error.h"
#include "export/destination.h"
#include "export/read_source.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::unique_ptr<ExportFormat> make_export(const ExportContext& context) {
    switch (context.options.kind) {
        case ExportKind::yolo:
            return make_yolo_export(context);
        case ExportKind::coco:
            return make_coco_export(context);
        case ExportKind::masks:
            return make_masks_export(context);
        case ExportKind::imagefolder:
            return make_imagefolder_export(context);
        case ExportKind::webdataset:
            return make_webdataset_export(context);
    }
    throw std::logic_error("an unknown format");
}

/// Everything that the bytes of an export depend on.
Json identity_of(const ExportSource& source, const ExportOptions& options) {
    Json json = {{"format", "sonarsim export"},
                 {"program_version", SONARSIM_VERSION},
                 {"kind", static_cast<int>(options.kind)},
                 {"sensors", options.sensors},
                 {"without", options.without},
                 {"bins", options.bins},
                 {"polygons", options.polygons},
                 {"tile_px", options.tile_px},
                 {"overlap_px", options.overlap_px},
                 {"least_share", options.least_share},
                 {"least_pixels", options.least_pixels},
                 {"licence", options.licence}};
    json["datasets"] = Json::array();
    for (const SourceDataset& dataset : source.datasets)
        json["datasets"].push_back(dataset.description);
    return json;
}

/// Two datasets of a collection may give two pictures the same name.
std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    std::string unique = name;
    for (int other = 2; !taken.insert(unique).second; ++other)
        unique = name + "-" + std::to_string(other);
    return unique;
}

}  // namespace

ExportSummary export_dataset(const fs::path& folder, const fs::path& dest,
                             const ExportOptions& options, const ProgressCallback& progress,
                             const std::atomic<bool>& stop) {
    ExportSource source = read_export_source(folder, options);
    const Json identity = identity_of(source, options);
    ExportDestination destination(dest, identity, {folder});
    ExportSummary summary;
    if (destination.is_there()) {
        summary.was_there = summary.complete = true;
        return summary;
    }
    const std::unique_ptr<ExportFormat> format =
        make_export({destination.part(), options, source.classes, identity["datasets"]});
    std::uint64_t total = 0;
    std::uint64_t done = 0;
    for (const SourceDataset& dataset : source.datasets)
        total += dataset.pictures.size();
    std::set<std::string> taken;
    for (SourceDataset& dataset : source.datasets) {
        const auto objects = read_source_objects(source, dataset);
        PixelReader reader;
        for (SourcePicture& picture : dataset.pictures) {
            if (stop) return summary;
            picture.name = unique_name(picture.name, taken);
            const auto own = objects.find(picture.id);
            for_each_exported(picture,
                              own == objects.end() ? std::vector<SourceObject>() : own->second,
                              reader, options, summary.left_out, [&](const ExportedPicture& one) {
                                  format->add(one);
                                  ++summary.pictures[part_text(one.part)];
                                  summary.without_objects += one.objects.empty();
                                  for (const SourceObject& object : one.objects) {
                                      if (object.is_crowd) continue;
                                      ++summary.objects[source.classes[object.class_number - 1]];
                                  }
                              });
            if (progress) progress(++done, total);
        }
    }
    if (summary.pictures.empty()) {
        throw InputError({folder.string()},
                         "has no picture whose pings are in one part of the split; --tile cuts "
                         "waterfalls and echograms");
    }
    format->finish();
    destination.commit();
    summary.complete = true;
    return summary;
}

}  // namespace sonarsim
