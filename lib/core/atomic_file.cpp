#include "core/atomic_file.h"

namespace sonarsim {

StreamedFile::StreamedFile(const std::filesystem::path& path)
    : atomic_file_(path), file_(std::fopen(atomic_file_.part().c_str(), "wbe")) {
    if (!file_) throw_errno("cannot write", atomic_file_.part());
}

void StreamedFile::append(std::string_view bytes) {
    constexpr std::size_t max_pending = std::size_t{1} << 16;
    pending_ += bytes;
    if (pending_.size() < max_pending) return;
    put(pending_);
    pending_.clear();
}

void StreamedFile::put(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
        throw_errno("cannot write", atomic_file_.part());
    }
}

void StreamedFile::finish() {
    put(pending_);
    if (std::fclose(file_.release()) != 0) throw_errno("cannot write", atomic_file_.part());
    atomic_file_.commit();
}

}  // namespace sonarsim
