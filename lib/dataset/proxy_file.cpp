#include "dataset/proxy_file.h"

#include <cerrno>
#include <system_error>

namespace sonarsim {

ProxyFile::ProxyFile(const std::filesystem::path& path)
    : IOProxy(path.string(), Write), path_(path), file_(std::fopen(path.c_str(), "w+be")) {
    note(file_ != nullptr);
    if (!file_) finish();
}

void ProxyFile::finish() {
    if (file_) note(std::fclose(file_.release()) == 0);
    if (fault_ != 0) {
        throw std::system_error(fault_, std::generic_category(), "cannot write " + path_.string());
    }
}

int64_t ProxyFile::tell() {
    return ftello(file_.get());
}

bool ProxyFile::seek(int64_t offset) {
    return note(fseeko(file_.get(), offset, SEEK_SET) == 0);
}

std::size_t ProxyFile::read(void* bytes, std::size_t size) {
    return std::fread(bytes, 1, size, file_.get());
}

std::size_t ProxyFile::write(const void* bytes, std::size_t size) {
    const std::size_t taken = std::fwrite(bytes, 1, size, file_.get());
    note(taken == size);
    return taken;
}

std::size_t ProxyFile::pread(void* bytes, std::size_t size, int64_t offset) {
    const int64_t back = tell();
    const std::size_t got = seek(offset) ? read(bytes, size) : 0;
    seek(back);
    return got;
}

std::size_t ProxyFile::pwrite(const void* bytes, std::size_t size, int64_t offset) {
    const int64_t back = tell();
    const std::size_t taken = seek(offset) ? write(bytes, size) : 0;
    seek(back);
    return taken;
}

std::size_t ProxyFile::size() const {
    const int64_t back = ftello(file_.get());
    if (fseeko(file_.get(), 0, SEEK_END) != 0) return 0;
    const int64_t end = ftello(file_.get());
    return fseeko(file_.get(), back, SEEK_SET) == 0 ? static_cast<std::size_t>(end) : 0;
}

bool ProxyFile::note(bool done) {
    if (!done && fault_ == 0) fault_ = errno != 0 ? errno : EIO;
    return done;
}

}  // namespace sonarsim
