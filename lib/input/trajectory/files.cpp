#include <cmath>
#include <iterator>

#include "core/csv.h"
#include "core/error.h"
#include "core/file.h"
#include "core/input_limits.h"
#include "core/text.h"
#include "core/units.h"
#include "input/mission/document.h"
#include "input/mission/limits.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_bytes = std::size_t{64} << 20;

/// A column and the largest magnitude that is plausible in it.
struct Column {
    std::string_view name;
    double limit;
};

/// All columns: of every file, then of the two attitude formats. TUM files have the first eight.
constexpr Column all_columns[] = {{"t_s", furthest_s}, {"x_m", furthest_m}, {"y_m", furthest_m},
                                  {"z_m", furthest_m}, {"qx", 1e9},         {"qy", 1e9},
                                  {"qz", 1e9},         {"qw", 1e9},         {"roll_deg", 1e6},
                                  {"pitch_deg", 1e6},  {"yaw_deg", 1e6}};
constexpr std::span<const Column> time_and_place(all_columns, 4);
constexpr std::span<const Column> quaternion_columns(all_columns + 4, 4);
constexpr std::span<const Column> angle_columns(all_columns + 8, 3);
constexpr std::size_t tum_fields = 8;
constexpr const char* header_help =
    "t_s, x_m, y_m, z_m and either qx, qy, qz, qw or roll_deg, pitch_deg, yaw_deg";

double field_value(std::string_view field, const Column& column, const Location& where) {
    const std::optional<double> value = parse_number(field);
    if (value && std::fabs(*value) <= column.limit) return *value;
    const std::string cell = fmt::format("{}: {}", column.name, in_quotes(field, 40));
    if (!value) refuse(where, "{} is not a number", cell);
    if (!std::isfinite(*value)) refuse(where, "{} is not a finite number", cell);
    refuse(where, "{} is beyond {}; the column's name gives the unit", cell,
           number_text(column.limit));
}

Eigen::Quaterniond unit_quaternion(std::span<const double, 4> xyzw, const Location& where) {
    const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double norm = q.norm();
    if (norm == 0.0) refuse(where, "the quaternion is zero; a rotation has norm 1");
    if (std::fabs(norm - 1.0) > 1e-3)
        refuse(where, "the quaternion has norm {}; a rotation has norm 1 (1e-3 off is tolerated)",
               number_text(norm));
    // Unit quaternions keep their bits, so that written poses read back exactly.
    return std::fabs(norm - 1.0) < 1e-14 ? q : q.normalized();
}

/// Takes `values` in the order of the columns.
TimedPose pose_from(std::span<const double> values, const Location& where) {
    const auto attitude = values.subspan(time_and_place.size());
    const Eigen::Quaterniond rotation =
        attitude.size() == quaternion_columns.size()
            ? unit_quaternion(attitude.first<4>(), where)
            : rotation_from_rpy(radians(attitude[0]), radians(attitude[1]), radians(attitude[2]));
    return {values[0], {rotation, {values[1], values[2], values[3]}}};
}

void append(Trajectory& trajectory, const TimedPose& pose, const Location& where) {
    if (!trajectory.empty() && !(pose.t_s > trajectory.back().t_s)) {
        refuse(where,
               "time {} s does not come after the {} s of the pose before; times must increase "
               "strictly",
               number_text(pose.t_s), number_text(trajectory.back().t_s));
    }
    trajectory.push_back(pose);
}

Trajectory require_poses(Trajectory trajectory, const std::string& file) {
    if (trajectory.empty()) refuse(Location{file}, "holds no pose; at least one is needed");
    return trajectory;
}

void check_names(std::span<const std::string> header, const Location& where) {
    const std::vector<std::string> known = names_of(all_columns);
    for (std::size_t i = 0; i < header.size(); ++i) {
        const std::string name = in_quotes(header[i], 40);
        if (contains(header.first(i), header[i])) refuse(where, "column {} occurs twice", name);
        if (contains(known, header[i])) continue;
        refuse(where, "unknown column {}{}; expected {}", name, did_you_mean(header[i], known),
               header_help);
    }
}

/// The columns that a header has. InputError that lists the missing ones.
std::vector<Column> columns_of(std::span<const std::string> header, const Location& where) {
    check_names(header, where);
    const auto is_given = [&](const Column& column) { return contains(header, column.name); };
    const bool quaternion = std::ranges::any_of(quaternion_columns, is_given);
    if (quaternion == std::ranges::any_of(angle_columns, is_given))
        refuse(where, "{}; expected {}", quaternion ? "two attitudes" : "no attitude", header_help);
    const std::span<const Column> attitude = quaternion ? quaternion_columns : angle_columns;
    std::vector<Column> columns(time_and_place.begin(), time_and_place.end());
    columns.insert(columns.end(), attitude.begin(), attitude.end());
    std::vector<Column> missing;
    std::ranges::remove_copy_if(columns, std::back_inserter(missing), is_given);
    if (missing.empty()) return columns;
    refuse(where, "missing column {}; expected {}", listed(names_of(missing)), header_help);
}

std::vector<std::string_view> split_blanks(std::string_view line) {
    constexpr std::string_view blank = " \t\r";
    std::vector<std::string_view> fields;
    std::size_t begin = line.find_first_not_of(blank);
    while (begin != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(blank, begin), line.size());
        fields.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blank, end);
    }
    return fields;
}

}  // namespace

Trajectory parse_csv_trajectory(std::string_view text, const std::string& file) {
    Trajectory trajectory;
    std::vector<std::string> header;
    std::vector<Column> columns;
    std::vector<double> values;
    for_each_csv_row(text, file, [&](const CsvRow& row) {
        const Location where{file, row.line};
        if (header.empty()) {
            header = row.fields;
            columns = columns_of(header, where);
            values.resize(columns.size());
            return;
        }
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto at = std::ranges::find(header, columns[c].name);
            const auto& field = row.fields[static_cast<std::size_t>(at - header.begin())];
            values[c] = field_value(field, columns[c], where);
        }
        append(trajectory, pose_from(values, where), where);
    });
    return require_poses(std::move(trajectory), file);
}

Trajectory parse_tum(std::string_view text, const std::string& file) {
    Trajectory trajectory;
    text = without_byte_order_mark(text);
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const auto fields = split_blanks(line.substr(0, line.find('#')));
        if (fields.empty()) continue;
        const Location where{file, number};
        std::array<double, tum_fields> values{};
        if (fields.size() != values.size()) {
            refuse(where, "{} fields; a pose has 8: t x y z qx qy qz qw", fields.size());
        }
        for (std::size_t c = 0; c < values.size(); ++c) {
            const auto column = static_cast<int>(fields[c].data() - line.data()) + 1;
            values[c] = field_value(fields[c], all_columns[c], {file, number, column});
        }
        append(trajectory, pose_from(values, where), where);
    }
    return require_poses(std::move(trajectory), file);
}

Trajectory read_trajectory(const std::filesystem::path& file) {
    const std::string extension = in_lower_case(file.extension().string());
    const bool csv = extension == ".csv";
    if (!csv && extension != ".txt" && extension != ".tum") {
        refuse(Location{file.string()},
               "a trajectory's name ends in .csv, or in .txt or .tum for TUM poses");
    }
    const std::string text = read_file(file, max_bytes);
    return csv ? parse_csv_trajectory(text, file.string()) : parse_tum(text, file.string());
}

std::string write_tum(const Trajectory& trajectory) {
    std::string out = "# t_s x_m y_m z_m qx qy qz qw\n";
    for (const TimedPose& pose : trajectory) {
        const Eigen::Vector3d& p = pose.T_world_vehicle.translation;
        const Eigen::Quaterniond& q = pose.T_world_vehicle.rotation;
        out += number_text(pose.t_s);
        for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
            out += " " + number_text(value);
        }
        out += "\n";
    }
    return out;
}

}  // namespace sonarsim
