#include "guessed_materials.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

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

/// Words of meshes for materials of the table.
constexpr std::pair<const char*, const char*> synonyms[]{
    {"aluminum", "aluminium"}, {"cement", "concrete"}, {"plastic", "polyethylene"},
    {"stone", "rock"},         {"tire", "tyre"},       {"timber", "wood"},
    {"fabric", "cloth"},       {"fibreglass", "pvc"}};

/// The words of a name in small letters: "HullPaint_2" has hull and paint.
std::set<std::string> words_of(const std::string& name) {
    std::set<std::string> words;
    std::string word;
    bool was_small = false;
    for (const char c : name + ' ') {
        const auto byte = static_cast<unsigned char>(c);
        const bool letter = std::isalpha(byte) != 0;
        if (!letter || (was_small && std::isupper(byte) != 0)) {
            if (!word.empty()) words.insert(word);
            word.clear();
        }
        if (letter) word += static_cast<char>(std::tolower(byte));
        was_small = std::islower(byte) != 0;
    }
    for (const auto& [other, known] : synonyms) {
        if (words.contains(other)) words.insert(known);
    }
    return words;
}

/// The row of the table that fits a name best; null if none does.
const CsvRow* row_of(const CsvTable& table, const std::string& name) {
    const auto same = std::ranges::find_if(
        table.rows, [&](const CsvRow& row) { return row.fields.front() == name; });
    if (same != table.rows.end()) return &*same;
    const std::set<std::string> words = words_of(name);
    const CsvRow* best = nullptr;
    std::size_t most = 0;
    for (const CsvRow& row : table.rows) {
        const std::set<std::string> needed = words_of(row.fields.front());
        if (needed.size() <= most || !std::ranges::includes(words, needed)) continue;
        best = &row;
        most = needed.size();
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
