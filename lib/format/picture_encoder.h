#pragma once

#include <string>

#include "format/picture_module.h"

namespace sonarsim {

/// Writes OpenEXR, JPEG and WebP with OpenImageIO. The pixels are the program's own, so that this
/// process loads the library, which takes 0.2 s. The same picture gives the same bytes with the
/// same version of the libraries: no time is stamped.
class PictureEncoder {
  public:
    /// InputError without the module or the library; it names the package.
    PictureEncoder();

    /// The bytes of the file. Any number of threads may call it. std::runtime_error if the library
    /// refuses the picture.
    std::string encode(const SonarsimPicture& picture) const;

  private:
    SonarsimEncodePicture encode_;
};

}  // namespace sonarsim
