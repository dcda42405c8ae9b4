#include "scene/images/read_image.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include "core/child_process.h"
#include "core/error.h"
#include "core/known_format.h"
#include "core/module.h"
#include "core/text.h"
#include "scene/images/module.h"
#include "scene/images/stored_numbers.h"
#include "scene/images/tiff_tags.h"
#include "scene/images/whole_tiff.h"

namespace sonarsim {

namespace {

constexpr std::uintmax_t most_image_bytes = std::uintmax_t{1} << 31;

std::string first_bytes(const std::filesystem::path& path) {
    std::string bytes(16, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/// The name that OpenImageIO has for the format of a file; "" if it is none of those that are read.
std::string image_format(const std::filesystem::path& path) {
    const std::string bytes = first_bytes(path);
    if (bytes.starts_with("\x89PNG")) return "png";
    if (bytes.starts_with("\x76\x2f\x31\x01")) return "openexr";
    return is_tiff(path) ? "tiff" : "";
}

/// InputError unless the path is that of a regular file that can be opened and is not too large.
void require_readable(const std::filesystem::path& path, const Location& where) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(where, "no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(where, "is not a regular file");
    if (!std::ifstream(path, std::ios::binary)) throw InputError(where, "cannot be opened");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > most_image_bytes)
        throw InputError(where,
                         "is larger than 2 GiB; cut a part out with gdal_translate -projwin");
}

/// The last part of the bytes that the child hands over, after a head, the values and the reason of
/// a failure.
struct ImageEnd {
    std::uint64_t error_bytes = 0;
};

struct HandOver {
    ChildOutput write;
    bool begun = false;
};

bool has_too_many(const SonarsimImageHead& head) {
    return head.channels == 0 || head.width > most_image_values ||
           head.height > most_image_values ||
           head.width * head.height > most_image_values / head.channels;
}

int hand_over_head(void* user, const SonarsimImageHead* head) {
    auto& output = *static_cast<HandOver*>(user);
    output.begun = true;
    output.write(head, sizeof(*head));
    return has_too_many(*head) ? 1 : 0;
}

void hand_over_rows(void* user, const float* values, std::size_t count) {
    static_cast<HandOver*>(user)->write(values, count * sizeof(float));
}

/// Runs in the child. OpenImageIO is loaded only here: it brings threads and 260 libraries along.
void read_in_child(const ChildOutput& write, const std::string& format, const std::string& file) {
    std::array<char, 400> error{};
    std::string reason;
    HandOver output{write};
    try {
        const auto read = reinterpret_cast<SonarsimReadImage>(
            module_symbol(image_module, image_module_symbol, image_package));
        if (read(format.c_str(), file.c_str(), &hand_over_head, &hand_over_rows, &output,
                 error.data(), error.size()) != 0)
            reason = std::string(error.data()) + " (OpenImageIO says so)";
    } catch (const InputError& fault) {
        reason = fault.what();
    }
    if (!output.begun) {
        const SonarsimImageHead none{};
        write(&none, sizeof(none));
    }
    const ImageEnd end{reason.size()};
    write(reason.data(), reason.size());
    write(&end, sizeof(end));
}

/// A request to the child: the format, a zero and the file.
std::string request_of(const std::string& format, const std::filesystem::path& file) {
    return format + '\0' + file.string();
}

void answer_request(const std::string& request, const ChildOutput& write) {
    const std::size_t end = request.find('\0');
    read_in_child(write, request.substr(0, end), request.substr(end + 1));
}

/// Memory for the libraries and for two copies of the largest image as doubles.
constexpr ChildLimits image_limits{(std::size_t{1} << 30) + 16 * most_image_values, 120, 300.0};

[[noreturn]] void refuse_size(const SonarsimImageHead& head, const Location& where) {
    throw InputError(where, "has " + std::to_string(head.width) + " x " +
                                std::to_string(head.height) + " pixels of " +
                                std::to_string(head.channels) +
                                (head.channels == 1 ? " value" : " values") +
                                ", and at most 2^26 values are read; make it coarser with "
                                "gdal_translate -outsize 50% 50%, or cut a part out with "
                                "gdal_translate -projwin");
}

/// A file in memory, for libraries that read files.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view bytes) : MemoryFile() {
        std::ofstream(path(), std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    /// A copy of another file, with the bytes `stored.photometric_bytes` at
    /// `stored.photometric_offset`.
    MemoryFile(const std::filesystem::path& other, const StoredNumbers& stored) : MemoryFile() {
        std::ofstream copy(path(), std::ios::binary);
        copy << std::ifstream(other, std::ios::binary).rdbuf();
        copy.seekp(static_cast<std::streamoff>(stored.photometric_offset));
        copy.write(stored.photometric_bytes.data(), std::ssize(stored.photometric_bytes));
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// A path that is valid in this process and its child.
    std::filesystem::path path() const {
        return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_);
    }

  private:
    MemoryFile() : file_(memfd_create("image", MFD_CLOEXEC)) {
        if (file_ < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
    }

    int file_;
};

/// The bytes that the child hands over of a file.
std::string bytes_of_image(ChildProcess& child, const std::filesystem::path& path,
                           const std::string& format, const StoredNumbers& stored,
                           const Location& where) {
    try {
        if (stored.photometric_offset == 0) return child.answer(request_of(format, path));
        const MemoryFile copy(path, stored);
        return child.answer(request_of(format, copy.path()));
    } catch (const InputError& error) {
        throw InputError(where, std::string("is damaged or too large: OpenImageIO ") +
                                    error.what() + " as it read the file; export it again");
    }
}

/// The image that the child handed over.
Image image_of_bytes(const std::string& bytes, const Location& where) {
    Image image;
    SonarsimImageHead head;
    ImageEnd end;
    const std::size_t frame = sizeof(head) + sizeof(end);
    if (bytes.size() >= frame) {
        std::memcpy(&head, bytes.data(), sizeof(head));
        std::memcpy(&end, bytes.data() + bytes.size() - sizeof(end), sizeof(end));
    }
    if (bytes.size() < frame || end.error_bytes > bytes.size() - frame)
        throw InputError(where, "is damaged: OpenImageIO gave up; export it again");
    if (end.error_bytes > 0) {
        const std::size_t from = bytes.size() - sizeof(end) - end.error_bytes;
        std::string reason = bytes.substr(from, end.error_bytes);
        std::ranges::replace(reason, '\n', ' ');
        throw InputError(where, "cannot be read: " + printable(reason));
    }
    if (has_too_many(head)) refuse_size(head, where);
    image.width = static_cast<int>(head.width);
    image.height = static_cast<int>(head.height);
    image.channels = static_cast<int>(head.channels);
    image.bits = static_cast<int>(head.bits);
    image.is_float = head.is_float != 0;
    const std::size_t count = head.width * head.height * head.channels;
    if (bytes.size() != frame + count * sizeof(float))
        throw InputError(where, "is damaged: it has fewer rows than it says; export it again");
    image.values.resize(count);
    std::memcpy(image.values.data(), bytes.data() + sizeof(head), count * sizeof(float));
    return image;
}

}  // namespace

bool is_image_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) && !image_format(path).empty();
}

ImageReader::ImageReader() : child_(&answer_request, image_limits) {}

Image ImageReader::read_at(const std::filesystem::path& path, const Location& where,
                           bool has_place) {
    const std::string format = image_format(path);
    if (format.empty()) {
        const std::string bytes = first_bytes(path);
        if (bytes.starts_with("\xff\xd8\xff"))
            throw InputError(where,
                             "is a JPEG, whose values are not exact; save the image it was "
                             "made from as PNG, TIFF or OpenEXR");
        const std::string_view known = known_format(bytes);
        throw InputError(where, (known.empty() ? "is no image" : "is " + std::string(known)) +
                                    "; PNG, TIFF and OpenEXR are read");
    }
    if (format == "tiff") require_whole_tiff(path);
    Georeference reference;
    if (has_place) reference = read_georeference(path);
    const StoredNumbers stored = read_stored_numbers(path, format, where);
    Image image = image_of_bytes(bytes_of_image(child_, path, format, stored, where), where);
    image.reference = reference;
    restore_numbers(stored, where, image);
    return image;
}

Image ImageReader::read(const std::filesystem::path& path) {
    const Location where{path.string()};
    require_readable(path, where);
    return read_at(path, where, true);
}

Image ImageReader::read(std::string_view bytes, const Location& where) {
    const MemoryFile file(bytes);
    return read_at(file.path(), where, false);
}

Image read_image(const std::filesystem::path& path) {
    return ImageReader().read(path);
}

}  // namespace sonarsim
