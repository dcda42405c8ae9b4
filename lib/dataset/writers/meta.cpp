#include "dataset/ping_metadata.h"
#include "dataset/writer.h"

namespace sonarsim {

namespace {

/// meta/NNNNNN.json: time, poses, seed, counts and what was measured.
class MetaWriter final : public Writer {
  public:
    explicit MetaWriter(const WriterContext& context) : context_(context) {}

    WriterOutputs outputs() const override {
        constexpr double longest = 2500.0;
        return {PingFile{"meta", ".json"}, longest, {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return json_text(describe_ping(context_.mission, context_.assembly, finished));
    }

  private:
    WriterContext context_;
};

}  // namespace

std::unique_ptr<Writer> make_meta_writer(const WriterContext& context) {
    if (!context.mission.output.meta) return nullptr;
    return std::make_unique<MetaWriter>(context);
}

}  // namespace sonarsim
