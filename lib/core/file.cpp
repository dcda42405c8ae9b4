#include "core/file.h"

#include <sys/random.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <system_error>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

std::string reason() {
    return std::generic_category().message(errno);
}

/// A likely mistake in the path of a file that does not exist; "" if there is none.
std::string hint_of_path(const std::filesystem::path& path) {
    if (path.string().find('\\') != std::string::npos) return "; separate folders by '/', not '\\'";
    if (contains(path, "~"))
        return "; '~' is not replaced by the home folder: write the whole path";
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::error_code absent;
    if (!std::filesystem::is_directory(folder, absent))
        return "; there is no folder " + folder.string();
    constexpr std::size_t max_names = 1000;
    std::vector<std::string> names;
    std::filesystem::directory_iterator entry(folder, absent);
    for (; entry != std::filesystem::directory_iterator() && names.size() < max_names;
         entry.increment(absent))
        names.push_back(entry->path().filename().string());
    std::ranges::sort(names);
    return did_you_mean(path.filename().string(), names);
}

constexpr std::size_t random_bytes = 8;
constexpr std::string_view temporary_ending = ".part";

}  // namespace

void throw_errno(const char* what, const std::filesystem::path& path) {
    throw std::system_error(errno, std::generic_category(), what + (" " + path.string()));
}

std::string read_file(const std::filesystem::path& path, std::size_t limit) {
    const Location where{path.string()};
    Descriptor file(path, O_RDONLY | O_NONBLOCK);
    if (file.get() < 0) {
        const bool absent = errno == ENOENT;
        const std::string why = reason();
        refuse(where, "cannot open: {}{}", why, absent ? hint_of_path(path) : "");
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) refuse(where, "cannot read: {}", reason());
    if (S_ISDIR(status.st_mode)) refuse(where, "is a folder; a file is expected here");
    if (!S_ISREG(status.st_mode)) refuse(where, "is not a regular file");
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size > limit) refuse(where, "is {} bytes long; at most {} are read", size, limit);
    std::string bytes(size, '\0');
    const auto got = move_all(size, [&](std::size_t done) {
        return ::read(file.get(), bytes.data() + done, size - done);
    });
    if (!got) refuse(where, "cannot read: {}", reason());
    bytes.resize(*got);
    return bytes;
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
    std::array<std::uint8_t, random_bytes> random;
    if (::getrandom(random.data(), random.size(), 0) != random_bytes)
        throw_errno("cannot write", path);
    return path.parent_path() / ("." + path.filename().string() + "." + hex_text(random) + ".part");
}

bool is_temporary_name(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(temporary_ending)) return false;
    name.remove_suffix(temporary_ending.size());
    const std::size_t dot = name.rfind('.');
    const std::string_view digits = name.substr(dot + 1);
    return dot > 0 && digits.size() == 2 * random_bytes &&
           digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

AtomicFile::AtomicFile(const std::filesystem::path& path)
    : path_(path), part_(temporary_name(path)) {}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(part_, ignored);
}

void AtomicFile::commit() {
    if (std::rename(part_.c_str(), path_.c_str()) != 0) throw_errno("cannot write", path_);
    committed_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
    StreamedFile file(path);
    file.append(bytes);
    file.finish();
}

void write_file_durably(const std::filesystem::path& path, std::string_view bytes) {
    StreamedFile file(path);
    file.append(bytes);
    file.finish(Durable::yes);
    // The name in its folder is durable, too.
    const std::filesystem::path folder = path.parent_path();
    const Descriptor names(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
    if (names.get() < 0 || ::fsync(names.get()) != 0) throw_errno("cannot write", folder);
}

void sync_file_system(const std::filesystem::path& folder) {
    const Descriptor any(folder, O_RDONLY | O_DIRECTORY);
    if (any.get() < 0 || ::syncfs(any.get()) != 0) throw_errno("cannot write", folder);
}

StreamedFile::StreamedFile(const std::filesystem::path& path)
    : atomic_file_(path), file_(atomic_file_.part(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW) {
    if (file_.get() < 0) throw_errno("cannot write", atomic_file_.part());
}

void StreamedFile::append(std::string_view bytes) {
    constexpr std::size_t max_pending = std::size_t{1} << 16;
    if (pending_.size() + bytes.size() > max_pending) {
        put(pending_);
        pending_.clear();
    }
    if (bytes.size() > max_pending)
        put(bytes);
    else
        pending_ += bytes;
}

void StreamedFile::put(std::string_view bytes) {
    const auto done = move_all(bytes.size(), [&](std::size_t at) {
        return ::write(file_.get(), bytes.data() + at, bytes.size() - at);
    });
    if (done != bytes.size()) throw_errno("cannot write", atomic_file_.part());
}

void StreamedFile::finish(Durable durable) {
    put(pending_);
    if ((durable == Durable::yes && ::fsync(file_.get()) != 0) || !file_.close())
        throw_errno("cannot write", atomic_file_.part());
    atomic_file_.commit();
}

void require_no_link(const std::filesystem::path& path, const std::string& what) {
    if (!std::filesystem::is_symlink(path)) return;
    refuse(Location{path.string()},
           "is a symbolic link, and {} is written into folders of its own; remove the link or "
           "choose another output folder",
           what);
}

namespace {

/// A regular file that is no link, open for reading.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path)
        : where_{path.string()}, file_(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW) {
        struct stat status {};
        if (file_.get() < 0 || ::fstat(file_.get(), &status) != 0) refuse();
        if (!S_ISREG(status.st_mode)) throw InputError(where_, "is not a regular file");
        end_ = static_cast<std::size_t>(status.st_size);
    }

    std::string read(std::size_t offset, std::size_t size) const {
        std::string bytes(std::min(size, end_ - std::min(offset, end_)), '\0');
        const auto got = move_all(bytes.size(), [&](std::size_t done) {
            return ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                           static_cast<off_t>(offset + done));
        });
        if (!got) refuse();
        bytes.resize(*got);
        return bytes;
    }

  private:
    [[noreturn]] void refuse() const {
        throw InputError(where_, errno == ELOOP
                                     ? "is a symbolic link; put the file itself in its place"
                                     : "cannot be read: " + reason());
    }

    Location where_;
    Descriptor file_;
    std::size_t end_ = 0;
};

}  // namespace

std::string read_bytes(const std::filesystem::path& path, std::size_t offset, std::size_t size) {
    return RegularFile(path).read(offset, size);
}

void copy_regular_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    constexpr std::size_t piece = std::size_t{1} << 20;
    const RegularFile source(from);
    std::string bytes = source.read(0, piece);
    StreamedFile target(to);
    for (std::size_t at = 0; !bytes.empty(); bytes = source.read(at, piece)) {
        target.append(bytes);
        at += bytes.size();
    }
    target.finish();
}

ScratchFolder::ScratchFolder() {
    std::error_code fault;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(fault);
    if (fault) throw std::runtime_error("TMPDIR names no folder for temporary files");
    std::string name = (parent / "sonarsim-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw_errno("cannot make", name);
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace sonarsim
