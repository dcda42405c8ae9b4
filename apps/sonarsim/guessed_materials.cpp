#include "guessed_materials.h"

#include <regex>
#include <set>

#include "core/csv.h"
#include "core/error.h"
#include "input/mission/preset.h"
#include "input/scene/copy_number.h"
#include "input/scene/materials.h"

namespace sonarsim {

namespace {

constexpr const char* usual_material = "steel";
constexpr const char* usual_bed = "sand";
constexpr const char* nameless = "(no material)";  // as load_scene_geometry()
constexpr std::size_t largest_table = std::size_t{1} << 24;

/// The row of the table that fits a name best: of the same name, else of the longest name that
/// stands in it as a word; null if none does.
const CsvRow* row_of(const CsvTable& table, const std::string& name) {
    const CsvRow* best = nullptr;
    for (const CsvRow& row : table.rows) {
        const std::string& known = row.fields.front();
        if (known == name) return &row;
        const std::regex word("(^|[^a-z])" + known + "([^a-z]|$)", std::regex::icase);
        if ((!best || known.size() > best->fields.front().size()) && std::regex_search(name, word))
            best = &row;
    }
    return best;
}

std::string joined(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields)
        line += (&field == fields.data() ? "" : ",") + field;
    return line + "\n";
}

CsvTable known_materials() {
    const std::filesystem::path file = shipped_file("../scenes/materials.csv");
    if (file.empty())
        throw InputError("scenes/materials.csv, which comes with the program, is not there");
    return read_csv(file, largest_table);
}

}  // namespace

GuessedMaterials guess_materials(const Scene& mesh, const std::vector<std::string>& beds) {
    const CsvTable table = known_materials();
    GuessedMaterials out{joined(table.header.fields), {}, ""};
    std::set<std::string> written;
    const auto add = [&](const std::string& name, const char* usual) {
        if (!written.insert(name).second) return;
        const CsvRow* row = row_of(table, name);
        if (!row) row = row_of(table, usual);
        std::vector<std::string> fields = row->fields;
        if (fields.front() != name) {
            out.guesses.push_back("material " + name + ": " + fields.front());
            out.csv += "# guess: the numbers of " + fields.front() + "\n";
            fields.front() = csv_field(name);
        }
        out.csv += joined(fields);
    };
    for (const Material& material : mesh.materials) {
        if (material.name != nameless) {
            add(without_copy_number(material.name), usual_material);
            continue;
        }
        out.default_material = usual_material;
        out.guesses.push_back(std::string("surfaces without a material: ") + usual_material);
        add(usual_material, usual_material);
    }
    for (const std::string& bed : beds)
        add(bed, usual_bed);
    return out;
}

}  // namespace sonarsim
