#pragma once

#include <string>

#include "format/picture_module.h"

namespace sonarsim {

/// Writes OpenEXR, JPEG and WebP with OpenImageIO. This process loads the library itself, since the
/// pixels come from the program; loading takes 0.2 s. The same picture gives the same bytes with
/// the same version of the libraries: no time is stamped.
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
