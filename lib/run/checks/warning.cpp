#include "run/checks/warning.h"

namespace sonarsim {

namespace {

/// A format string as text for people: "N" in place of a number, "..." in place of a text.
std::string without_figures(std::string_view format) {
    std::string out;
    while (!format.empty()) {
        const std::size_t end = format.front() == '{' ? format.find('}') : std::string_view::npos;
        if (end == std::string_view::npos) {
            out += format.front();
            format.remove_prefix(1);
        } else {
            out += format[end - 1] == 's' ? "..." : "N";
            format.remove_prefix(end + 1);
        }
    }
    return out;
}

}  // namespace

std::string warning_table_markdown() {
    std::string text = "| | what is found | what helps | limit |\n|---|---|---|---|\n";
    for (const WarningText& row : warning_table()) {
        text += fmt::format("| {} | {} | {} | {} |\n", number_of(row.code),
                            without_figures(row.what), without_figures(row.cure), row.limit);
    }
    return text;
}

std::string number_of(WarningCode code) {
    return fmt::format("W{:02}", static_cast<int>(code));
}

std::string sentence(const Warning& warning) {
    return number_of(warning.code) + " " + warning.about + ": " + warning.what +
           (warning.cure.empty() ? "" : "; " + warning.cure);
}

std::string about_sensor(std::string_view name) {
    return "sensor '" + std::string(name) + "'";
}

}  // namespace sonarsim
