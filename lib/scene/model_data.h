#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace sonarsim {

/// Appends numbers to the first buffer of a model, and returns the index of a new accessor to them.
/// `count` is its number of elements; `component` and `type` are tinygltf's constants.
template <class T>
int add_accessor(tinygltf::Model& model, const std::vector<T>& values, std::size_t count,
                 int component, int type) {
    if (model.buffers.empty()) model.buffers.emplace_back();
    auto& data = model.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    data.resize(data.size() + view.byteLength);
    // memcpy takes no null pointer, which an empty vector may have.
    if (!values.empty())
        std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    model.bufferViews.push_back(std::move(view));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
}

}  // namespace sonarsim
