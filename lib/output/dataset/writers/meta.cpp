#include "output/dataset/json.h"
#include "output/dataset/writer.h"

namespace sonarsim {

/// meta/NNNNNN.json: time, poses, seed, counts and what was measured.
std::optional<Writer> make_meta_writer(const WriterContext& context) {
    return Writer{.per_ping = PingFile{"meta", ".json"},
                  .encode = [context](const FinishedPing& finished) {
                      return json_text(describe_ping(context.mission, context.assembly, finished));
                  }};
}

}  // namespace sonarsim
