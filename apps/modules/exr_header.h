#pragma once

/// OpenEXR reserves the bytes that an attribute states before it reads them: a file of 300 bytes
/// could take 4 GB. std::runtime_error unless the attributes of all parts lie in the file.
/// Layout: "OpenEXR File Layout", sections "Magic Number" to "Header", of the OpenEXR project.
void check_exr_header(const char* file);
