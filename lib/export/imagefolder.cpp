#include <spdlog/fmt/fmt.h>

#include <map>

#include "core/file.h"
#include "core/sha256.h"
#include "dataset/ping_metadata.h"
#include "export/croissant.h"
#include "export/format.h"
#include "export/objects_json.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// JSON on one line is YAML, too.
std::string json_word(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The image folder of Hugging Face's `datasets`: PART/NAME.png, PART/metadata.jsonl with a line
/// per picture, README.md, the card of the dataset, and croissant.json.
class ImageFolderExport final : public ExportFormat {
  public:
    explicit ImageFolderExport(const ExportContext& context) : context_(context) {}

    void add(const ExportedPicture& picture) override {
        const std::string part = part_text(picture.part);
        place_picture(picture, context_.folder / part, context_.options.link);
        Part& own = parts_[part];
        ++own.pictures;
        own.objects += picture.objects.size();
        for (const SourceObject& object : picture.objects)
            ++objects_[object.class_number];
        own.lines += json_word({{"file_name", picture.name + ".png"},
                                {"width", picture.width},
                                {"height", picture.height},
                                {"objects", objects_json(picture)}}) +
                     '\n';
    }

    void finish() override {
        for (const auto& [part, own] : parts_)
            write_file(context_.folder / part / "metadata.jsonl", own.lines);
        write_file(context_.folder / "README.md", card());
        write_file(context_.folder / "croissant.json", croissant());
    }

  private:
    struct Part {
        std::uint64_t pictures = 0;
        std::uint64_t objects = 0;
        std::string lines;
    };

    std::string card() const {
        const Json& first = context_.datasets.at(0);
        std::string text = "---\nlicense: " + json_word(context_.options.licence) +
                           "\npretty_name: " + json_word(first.at("mission")) +
                           "\ntask_categories:\n- object-detection\ntags:\n- sonar\n- synthetic\n"
                           "---\n\n# " +
                           one_line(first.at("mission").get<std::string>()) +
                           "\n\nSonar pictures that sonarsim " +
                           one_line(first.at("program_version").get<std::string>()) +
                           " simulated. They have 8 bits; the grey is the square root of the "
                           "intensity.\n\n| part | pictures | objects |\n|---|---|---|\n";
        for (const auto& [part, own] : parts_)
            text += fmt::format("| {} | {} | {} |\n", part, own.pictures, own.objects);
        text +=
            "\n`objects` in `metadata.jsonl` has lists with an entry per object: `bbox` is left, "
            "top, width and height in pixels, `area` counts pixels, `categories` numbers these "
            "classes:\n\n| number | class | objects |\n|---|---|---|\n";
        for (std::size_t k = 0; k < context_.classes.size(); ++k) {
            const auto found = objects_.find(static_cast<int>(k) + 1);
            text += fmt::format("| {} | {} | {} |\n", k, one_line(context_.classes[k]),
                                found == objects_.end() ? 0 : found->second);
        }
        text += "\n| mission | seed | mission_hash | SHA-256 of SHA256SUMS |\n|---|---|---|---|\n";
        for (const Json& dataset : context_.datasets) {
            text += fmt::format("| {} | {} | {} | {} |\n",
                                one_line(dataset.at("mission").get<std::string>()),
                                dataset.at("seed").get<std::string>(),
                                one_line(dataset.at("mission_hash").get<std::string>()),
                                dataset.at("sha256sums").get<std::string>());
        }
        return text;
    }

    std::string croissant() const {
        const Json& first = context_.datasets.at(0);
        CroissantInput input{.name = first.at("mission").get<std::string>(),
                             .description = "Sonar pictures with labels, simulated by sonarsim",
                             .licence = context_.options.licence,
                             .classes = context_.classes,
                             .parts = {}};
        for (const auto& [part, own] : parts_)
            input.parts.emplace_back(part, sha256(own.lines));
        return croissant_json(input).dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
    }

    /// Text from a dataset in a cell of a table: no line break, no bar, no tag.
    static std::string one_line(std::string text) {
        for (char& c : text) {
            if (static_cast<unsigned char>(c) < ' ' || c == '|' || c == '<' || c == '`') c = ' ';
        }
        return text;
    }

    ExportContext context_;
    std::map<std::string, Part> parts_;
    std::map<int, std::uint64_t> objects_;  ///< the number in each class
};

}  // namespace

std::unique_ptr<ExportFormat> make_imagefolder_export(const ExportContext& context) {
    return std::make_unique<ImageFolderExport>(context);
}

}  // namespace sonarsim
