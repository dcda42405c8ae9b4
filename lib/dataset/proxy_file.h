#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace sonarsim {

/// A new file as OpenImageIO's encoders write to it. They do not look at what becomes of their
/// writes, so this keeps the first fault until it is asked.
class ProxyFile final : public OIIO::Filesystem::IOProxy {
  public:
    /// std::system_error when the file cannot be made.
    explicit ProxyFile(const std::filesystem::path& path);

    /// After the last write. std::system_error when the disk did not take every byte.
    void finish();

    const char* proxytype() const override { return "sonarsim"; }
    int64_t tell() override;
    bool seek(int64_t offset) override;
    std::size_t read(void* bytes, std::size_t size) override;
    std::size_t write(const void* bytes, std::size_t size) override;
    std::size_t pread(void* bytes, std::size_t size, int64_t offset) override;
    std::size_t pwrite(const void* bytes, std::size_t size, int64_t offset) override;
    std::size_t size() const override;

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    bool note(bool done);

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    int fault_ = 0;  ///< errno of the first
};

}  // namespace sonarsim
