#pragma once

#include <filesystem>
#include <string_view>

#include "core/child_process.h"
#include "core/error.h"
#include "scene/images/image.h"

namespace sonarsim {

/// True if the file begins like a PNG, TIFF or OpenEXR image.
bool is_image_file(const std::filesystem::path& path);

/// Reads PNG, TIFF (GeoTIFF, BigTIFF) and OpenEXR images; their content says which. OpenImageIO
/// reads them in a child process, since damaged files make such libraries crash, and since it needs
/// 0.3 s and threads to load. One child reads all images. It reads the first of several images in a
/// file. InputError for a file that is damaged, has another format or more values than
/// `most_image_values`, and without OpenImageIO. Not thread-safe.
class ImageReader {
  public:
    ImageReader();

    Image read(const std::filesystem::path& path);

    /// The same for the bytes of a file without a path. `where` names them in messages.
    Image read(std::string_view bytes, const Location& where);

    /// Ends the child; another image starts it again.
    void end() { child_.end(); }

  private:
    Image read_at(const std::filesystem::path& path, const Location& where, bool has_place);

    ChildProcess child_;
};

/// Reads one image.
Image read_image(const std::filesystem::path& path);

}  // namespace sonarsim
