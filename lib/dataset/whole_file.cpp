#include "dataset/whole_file.h"

#include <cerrno>
#include <system_error>

#include "core/file.h"

namespace sonarsim {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
    throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& path)
    : path_(path), part_(temporary_name(path)) {}

WholeFile::~WholeFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(part_, ignored);
}

void WholeFile::keep() {
    std::filesystem::rename(part_, path_);
    kept_ = true;
}

StreamedFile::StreamedFile(const std::filesystem::path& path)
    : whole_(path), file_(std::fopen(whole_.part().c_str(), "wbe")) {
    if (!file_) fail(whole_.part());
}

void StreamedFile::append(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
        fail(whole_.part());
    }
}

void StreamedFile::finish() {
    if (std::fclose(file_.release()) != 0) fail(whole_.part());
    whole_.keep();
}

}  // namespace sonarsim
