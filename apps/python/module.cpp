// The compiled part of the package. sonarsim/__init__.py is what users see, and checks arguments.
#include <malloc.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>
#include <system_error>

#include "core/build_info.h"
#include "core/error.h"
#include "input/mission/parse.h"
#include "run/checks/find_warnings.h"
#include "run/job/ping_source.h"
#include "simulate/assembly/mission_objects.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/kinds.h"

namespace py = pybind11;

namespace sonarsim {

namespace {

/// glTF files that the variants of a mission share.
struct SharedModels {
    std::mutex mutex;
    SceneStore files;
};

/// A mission whose files are read when first needed, by any thread, without the interpreter lock.
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
        all.reserve(static_cast<std::size_t>(variants.size()));
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
