#include "simulate/visibility/embree_build.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

#include "simulate/visibility/embree_trace.h"

namespace sonarsim {

void check_embree(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error(std::string("Embree failed while ") + doing + ", error " +
                                 std::to_string(static_cast<int>(error)));
    }
}

EmbreeTree make_tree(RTCDevice device, std::span<const Eigen::Vector3f> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles) {
    EmbreeTree tree(device);
    if (!triangles.empty()) put_mesh(device, tree, 0, vertices, triangles);
    commit(device, tree);
    return tree;
}

void put_mesh(RTCDevice device, const EmbreeTree& into, unsigned int index,
              std::span<const Eigen::Vector3f> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* points = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Eigen::Vector3f), vertices.size());
    void* corners = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(triangles[0]), triangles.size());
    if (points && corners) {
        std::copy(vertices.begin(), vertices.end(), static_cast<Eigen::Vector3f*>(points));
        std::copy(triangles.begin(), triangles.end(),
                  static_cast<std::array<std::uint32_t, 3>*>(corners));
        rtcSetGeometryIntersectFilterFunction(mesh, &keep_hits);
        rtcSetGeometryOccludedFilterFunction(mesh, &keep_hits);
        rtcCommitGeometry(mesh);
        rtcAttachGeometryByID(into.get(), mesh, index);
    }
    rtcReleaseGeometry(mesh);
    check_embree(device, "copying the scene");
}

bool has_first_mesh(const EmbreeTree& tree, std::span<const Eigen::Vector3f> vertices,
                    std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry mesh = rtcGetGeometry(tree.get(), 0);
    const auto holds = [&](RTCBufferType type, auto items) {
        return std::memcmp(rtcGetGeometryBufferData(mesh, type, 0), items.data(),
                           items.size_bytes()) == 0;
    };
    // The same triangles have the same number of vertices.
    return holds(RTC_BUFFER_TYPE_INDEX, triangles) && holds(RTC_BUFFER_TYPE_VERTEX, vertices);
}

void commit(RTCDevice device, const EmbreeTree& tree) {
    rtcCommitScene(tree.get());
    check_embree(device, "building its tree");
}

void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform) {
    transform.leftCols<3>() = transform.leftCols<3>().unaryExpr(&flush_to_zero).eval();
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, tree.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(into.get(), instance, index);
    rtcReleaseGeometry(instance);
}

}  // namespace sonarsim
