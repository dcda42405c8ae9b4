#include "run/job/ping_source.h"

#include <variant>

#include "output/dataset/encode_ping.h"
#include "output/dataset/layout.h"
#include "output/dataset/metadata.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

namespace {

/// The name and the extension of a writer's file or record.
std::filesystem::path file_of(const Writer& writer) {
    if (const auto* record = std::get_if<PingRecord>(&writer.per_ping)) return record->file;
    const auto& file = std::get<PingFile>(writer.per_ping);
    return file.name + file.extension;
}

}  // namespace

PingSource::PingSource(const Mission& of, Assembly assembled)
    : mission(of), assembly(std::move(assembled)), engine_(make_engine(mission, assembly)) {
    for (std::size_t i = 0; i < mission.sensors.size(); ++i) {
        const std::size_t pings = count_pings(mission.sensors[i], assembly.trajectory.size());
        plans_.push_back(plan_labels(mission, assembly, assembly.sonars[i]));
        writers_.push_back(make_array_writers({mission, assembly, i, pings}));
    }
}

PingInMemory PingSource::ping(const PingId& id) const {
    RenderedPing rendered = render_at_pose(mission, assembly, *engine_, id);
    brightest_pixel(rendered.ping, rendered.sonar->config.name, id.pose);
    PingInMemory out;
    finish_ping(assembly, plans_[id.sensor], rendered, [&](const FinishedPing& finished) {
        for (const Writer& writer : writers_[id.sensor]) {
            const std::filesystem::path file = file_of(writer);
            if (writer.numbers)
                out.arrays.emplace_back(file.stem().string(), writer.numbers(finished));
            else
                out.texts.emplace_back(file.stem().string(), file.extension().string(),
                                       writer.encode(finished));
        }
        out.metadata = json_text(describe_ping(mission, assembly, finished));
    });
    out.image = numbers_of(*rendered.sonar, std::move(rendered.ping.intensity), 0.0F);
    return out;
}

std::string PingSource::describe() const {
    const Layout layout =
        make_layout(mission, make_writers(mission, assembly), assembly.trajectory.size());
    return json_text(describe_dataset(mission, assembly, layout));
}

}  // namespace sonarsim
