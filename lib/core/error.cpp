#include "core/error.h"

#include "core/text.h"

namespace sonarsim {

std::string Location::text() const {
    std::string out = file;
    if (line > 0) out += ":" + std::to_string(line);
    if (line > 0 && column > 0) out += ":" + std::to_string(column);
    return out;
}

InputError::InputError(const Location& where, const std::string& what)
    : std::runtime_error(where.text() + ": " + what) {}

void ErrorList::add(const InputError& error) {
    const std::string text = error.what();
    if (contains(kept_, text)) return;
    ++count_;
    if (kept_.size() < max_kept) kept_.push_back(text);
}

void ErrorList::raise() const {
    if (kept_.empty()) return;
    std::string all = listed(kept_, "\n");
    if (count_ > kept_.size())
        all += "\nand " + std::to_string(count_ - kept_.size()) + " more errors like these";
    throw InputError(all);
}

}  // namespace sonarsim
