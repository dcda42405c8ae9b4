// The compiled part of the Python package: a mission and its pings. sonarsim/__init__.py is what
// users see, and checks their arguments.
#include <malloc.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/build_info.h"
#include "core/error.h"
#include "input/mission/parse.h"
#include "output/dataset/encode_ping.h"
#include "output/dataset/metadata.h"
#include "run/checks/find_warnings.h"
#include "simulate/assembly/mission_objects.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/kinds.h"
#include "simulate/visibility/make_engine.h"

namespace py = pybind11;

namespace sonarsim {

namespace {

/// A ping in memory, with the values that its files would hold.
struct PingInMemory {
    PingNumbers image;  ///< float32: polar/ [range, azimuth], or the record of the kind
    /// Raw values and labels, by the names of their files.
    std::vector<std::pair<std::string, PingNumbers>> arrays;
    /// Labels that are text: the name of the file, its extension and the text.
    std::vector<std::tuple<std::string, std::string, std::string>> texts;
    std::string metadata;  ///< meta/NNNNNN.json
};

/// The name and the extension of a writer's file or record.
std::filesystem::path file_of(const Writer& writer) {
    if (const auto* record = std::get_if<PingRecord>(&writer.per_ping)) return record->file;
    const auto& file = std::get<PingFile>(writer.per_ping);
    return file.name + file.extension;
}

/// Takes the intensities out of `ping`.
PingNumbers take_image(const Sonar& sonar, Ping& ping) {
    const KindOfSonar& kind = kind_of(sonar.config.kind);
    if (kind.has_images)
        return make_numbers(std::move(ping.intensity), ping.range_bins, ping.beams);
    return make_numbers(record_values(kind.record, sonar.config, ping.intensity, 0.0F));
}

/// The pings of a mission without files. They equal those of run_job(), and do not depend on which
/// other pings are requested.
class PingSource {
  public:
    /// `assembly` is that of the mission, which must outlive it.
    PingSource(const Mission& of, Assembly assembled)
        : mission(of), assembly(std::move(assembled)), engine_(make_engine(mission, assembly)) {
        const std::vector<std::size_t> pings = count_pings(mission, assembly.trajectory.size());
        for (std::size_t i = 0; i < pings.size(); ++i) {
            plans_.push_back(plan_labels(mission, assembly, assembly.sonars[i]));
            writers_.push_back(make_array_writers({mission, assembly, i, pings[i]}));
        }
    }
    PingSource(const PingSource&) = delete;
    PingSource& operator=(const PingSource&) = delete;

    /// Any number of threads may call it at a time. The id must be one of list_pings().
    /// std::runtime_error as brightest_pixel().
    PingInMemory ping(const PingId& id) const {
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
        out.image = take_image(*rendered.sonar, rendered.ping);
        return out;
    }

    /// dataset.json of the dataset that run_job() would begin. InputError as make_writers().
    std::string describe() const {
        const Layout layout =
            make_layout(mission, make_writers(mission, assembly), assembly.trajectory.size());
        return json_text(describe_dataset(mission, assembly, layout));
    }

    const Mission& mission;
    const Assembly assembly;

  private:
    std::unique_ptr<VisibilityEngine> engine_;
    std::vector<LabelPlan> plans_;  ///< in the order of the sensors
    std::vector<Writers> writers_;  ///< the same for raw values and labels
};

/// glTF files that the variants of a mission share.
struct SharedModels {
    std::mutex mutex;
    SceneStore files;
};

/// A mission whose files are read when they are first needed. Its functions may be called by any
/// thread and hold no interpreter lock.
class LoadedMission {
  public:
    LoadedMission(Mission mission, MissionSource source, std::shared_ptr<SharedModels> models)
        : mission_(std::move(mission)), source_(std::move(source)), models_(std::move(models)) {}

    const Mission& mission() const { return mission_; }

    const PingSource& pings() {
        std::call_once(read_, [&] { pings_ = std::make_unique<PingSource>(mission_, assembly()); });
        return *pings_;
    }

    std::vector<std::shared_ptr<LoadedMission>> variants() const {
        const auto models = std::make_shared<SharedModels>();
        std::vector<std::shared_ptr<LoadedMission>> all;
        const Variants variants = variants_of(mission_, source_);
        for (int i = 0; i < variants.size(); ++i)
            all.push_back(std::make_shared<LoadedMission>(variants[i], source_, models));
        return all;
    }

    /// The same mission with nothing read yet.
    std::shared_ptr<LoadedMission> unread() const {
        return std::make_shared<LoadedMission>(mission_, source_, models_);
    }

  private:
    Assembly assembly() const {
        if (!models_) return assemble(mission_);
        const std::lock_guard lock(models_->mutex);
        return assemble(mission_, models_->files);
    }

    Mission mission_;
    MissionSource source_;
    std::shared_ptr<SharedModels> models_;  ///< null: no other mission shares them
    std::once_flag read_;
    std::unique_ptr<PingSource> pings_;
};

std::shared_ptr<LoadedMission> load(const std::string& file, const std::string& paths_from,
                                    std::vector<std::string> settings,
                                    std::optional<std::string> text) {
    MissionSource source{file, paths_from, std::move(settings), std::move(text)};
    Mission mission = load_mission(source, sonar_keys());
    return std::make_shared<LoadedMission>(std::move(mission), std::move(source), nullptr);
}

/// [poses, 8]: t, x, y, z, qx, qy, qz, qw, as in trajectory.tum.
std::vector<double> pose_rows(const Trajectory& trajectory) {
    std::vector<double> rows;
    rows.reserve(8 * trajectory.size());
    for (const TimedPose& pose : trajectory) {
        const Eigen::Vector3d& p = pose.T_world_vehicle.translation;
        const Eigen::Quaterniond& q = pose.T_world_vehicle.rotation;
        rows.insert(rows.end(), {pose.t_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
    }
    return rows;
}

std::vector<std::string> warnings(LoadedMission& loaded) {
    std::vector<std::string> sentences;
    for (const Warning& warning : warnings_before_pings(loaded.mission(), loaded.pings().assembly))
        sentences.push_back(sentence(warning));
    return sentences;
}

PingInMemory make_ping(LoadedMission& loaded, std::uint32_t pose, std::uint32_t sensor) {
    const PingSource& pings = loaded.pings();
    if (sensor >= pings.assembly.sonars.size()) throw std::out_of_range("no such sensor");
    const auto every = static_cast<std::uint32_t>(loaded.mission().sensors[sensor].every);
    if (pose >= pings.assembly.trajectory.size() || pose % every != 0)
        throw std::out_of_range("no such ping");
    return pings.ping({.pose = pose, .sensor = sensor});
}

// From here on the interpreter lock is held.

/// An array that owns the values; they are not copied.
template <class T>
py::array as_array(std::vector<T> values, const std::vector<std::size_t>& shape) {
    auto owner = std::make_unique<std::vector<T>>(std::move(values));
    const T* data = owner->data();
    const py::capsule free(owner.get(),
                           [](void* all) { delete static_cast<std::vector<T>*>(all); });
    owner.release();  // NOLINT(bugprone-unused-return-value): the capsule has it
    return py::array_t<T>(shape, data, free);
}

py::array as_array(PingNumbers numbers) {
    return std::visit([&](auto& values) { return as_array(std::move(values), numbers.shape); },
                      numbers.values);
}

/// (image, {name: array}, {name: (extension, text)}, JSON of the metadata)
py::tuple ping(LoadedMission& loaded, std::uint32_t pose, std::uint32_t sensor) {
    PingInMemory made = [&] {
        const py::gil_scoped_release unlocked;
        return make_ping(loaded, pose, sensor);
    }();
    py::dict arrays;
    for (auto& [name, numbers] : made.arrays)
        arrays[py::str(name)] = as_array(std::move(numbers));
    py::dict texts;
    for (const auto& [name, extension, text] : made.texts)
        texts[py::str(name)] = py::make_tuple(extension, text);
    return py::make_tuple(as_array(std::move(made.image)), arrays, texts, made.metadata);
}

py::array poses(LoadedMission& loaded) {
    std::vector<double> rows = [&] {
        const py::gil_scoped_release unlocked;
        return pose_rows(loaded.pings().assembly.trajectory);
    }();
    const std::size_t count = rows.size() / 8;
    return as_array(std::move(rows), {count, 8});
}

std::vector<std::pair<std::string, int>> sensors(const LoadedMission& loaded) {
    std::vector<std::pair<std::string, int>> all;
    for (const SonarConfig& sensor : loaded.mission().sensors)
        all.emplace_back(sensor.name, sensor.every);
    return all;
}

/// Sets the limits that the C library chooses by itself once an array of 32 MB is freed. Until then
/// it hands the memory of every ping back to the kernel, which takes a tenth of the ping's time.
void keep_freed_memory() {
    constexpr int largest = 32 << 20;
    // NOLINTBEGIN(concurrency-mt-unsafe): malloc takes its own lock
    mallopt(M_MMAP_THRESHOLD, largest);
    mallopt(M_TRIM_THRESHOLD, 2 * largest);
    // NOLINTEND(concurrency-mt-unsafe)
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11's signature
void raise_as_os_error(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const std::system_error& error) {
        PyErr_SetString(PyExc_OSError, error.what());
    }
}

}  // namespace

PYBIND11_MODULE(_sonarsim, module) {
    using Unlocked = py::call_guard<py::gil_scoped_release>;
    keep_freed_memory();
    module.attr("version") = build_info().version;
    py::register_exception_translator(raise_as_os_error);
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
    py::class_<LoadedMission, std::shared_ptr<LoadedMission>>(module, "LoadedMission")
        .def_property_readonly("name", [](const LoadedMission& m) { return m.mission().name; })
        .def_property_readonly("seed", [](const LoadedMission& m) { return m.mission().seed; })
        .def_property_readonly("variant",
                               [](const LoadedMission& m) { return m.mission().variant.index; })
        .def_property_readonly("variant_count",
                               [](const LoadedMission& m) { return m.mission().variants; })
        .def_property_readonly("sensors", sensors)
        .def(
            "read", [](LoadedMission& m) { m.pings(); }, Unlocked())
        .def("unread", &LoadedMission::unread)
        .def("variants", &LoadedMission::variants, Unlocked())
        .def(
            "pose_count", [](const LoadedMission& m) { return vehicle_poses(m.mission()).size(); },
            Unlocked())
        .def("poses", poses)
        .def("warnings", warnings, Unlocked())
        .def(
            "describe", [](LoadedMission& m) { return m.pings().describe(); }, Unlocked())
        .def("ping", ping, py::arg("pose"), py::arg("sensor"));
    module.def("load", load, py::arg("file"), py::arg("paths_from"), py::arg("settings"),
               py::arg("text"), Unlocked());
}

}  // namespace sonarsim
