#include "core/scene/gltf_nodes.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <tiny_gltf.h>

namespace hybray {
namespace {

std::string place(const GltfFile& file, size_t node) {
  return file.at(fmt::format("/nodes/{}", node));
}

// Parent of each node, -1 for roots; checks that the nodes are trees.
std::vector<int> parents(const GltfFile& file) {
  const auto& nodes = file.model.nodes;
  std::vector<int> parent(nodes.size(), -1);
  for (size_t n = 0; n < nodes.size(); ++n)
    for (const int child : nodes[n].children) {
      int& p = parent[static_cast<size_t>(child)];
      if (p >= 0)
        throw InputError(place(file, n) + "/children",
                         fmt::format("node {} is a child of node {} already", child, p));
      p = static_cast<int>(n);
    }
  std::vector<int> walk(nodes.size(), -1);  // the start of the upward walk that visited the node last
  for (size_t start = 0; start < nodes.size(); ++start)
    for (auto n = static_cast<int>(start); n >= 0; n = parent[static_cast<size_t>(n)]) {
      int& seen = walk[static_cast<size_t>(n)];
      if (seen == static_cast<int>(start)) throw InputError(place(file, start), "the node is above itself");
      if (seen >= 0) break;
      seen = static_cast<int>(start);
    }
  return parent;
}

std::vector<size_t> roots(const GltfFile& file) {
  const std::vector<int> parent = parents(file);
  std::vector<size_t> list;
  if (file.model.scenes.empty()) {
    for (size_t n = 0; n < parent.size(); ++n)
      if (parent[n] < 0) list.push_back(n);
    return list;
  }
  const size_t scene = file.model.defaultScene < 0 ? 0 : static_cast<size_t>(file.model.defaultScene);
  std::vector<bool> listed(parent.size());
  for (const int root : file.model.scenes[scene].nodes) {
    const auto n = static_cast<size_t>(root);
    const std::string where = file.at(fmt::format("/scenes/{}/nodes", scene));
    if (parent[n] >= 0)
      throw InputError(where, fmt::format("node {} is no root: it is a child of node {}", n, parent[n]));
    if (listed[n]) throw InputError(where, fmt::format("node {} is listed twice", n));
    listed[n] = true;
    list.push_back(n);
  }
  return list;
}

dvec3 vector_or(const std::vector<double>& values, const dvec3& otherwise) {
  return values.empty() ? otherwise : dvec3(values[0], values[1], values[2]);
}

// Whether every entry is a finite float.
bool in_float_range(const dmat4& m) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!(std::abs(m[column][row]) <= kLargest)) return false;
  return true;
}

dmat4 local_transform(const GltfFile& file, size_t index) {
  const tinygltf::Node& node = file.model.nodes[index];
  dmat4 m(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
      throw InputError(place(file, index) + "/matrix", "not affine: its last row is not 0 0 0 1");
    return m;
  }
  if (!node.rotation.empty()) {
    const auto& q = node.rotation;
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 1e-6) || !std::isfinite(length))
      throw InputError(place(file, index) + "/rotation", "not a rotation: its length is zero or not finite");
    m = glm::mat4_cast(glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length));
  }
  const dvec3 scale = vector_or(node.scale, dvec3(1.0));
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = dvec4(vector_or(node.translation, dvec3(0.0)), 1.0);
  return m;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const GltfFile& file) {
  std::vector<PlacedNode> placed, open;
  const std::vector<size_t> first = roots(file);
  for (auto root = first.rbegin(); root != first.rend(); ++root) open.push_back({*root, dmat4(1.0)});
  while (!open.empty()) {
    PlacedNode node = open.back();
    open.pop_back();
    node.transform = node.transform * local_transform(file, node.node);
    if (!in_float_range(node.transform))
      throw InputError(place(file, node.node), "the transform is beyond the range of float");
    const dmat3 linear(node.transform);
    if (linear == dmat3(0.0)) continue;
    const double volume = std::abs(glm::determinant(linear));
    const double edges = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    if (!(volume > 1e-12 * edges))
      throw InputError(place(file, node.node), "the transform flattens space, so that it has no inverse");
    placed.push_back(node);
    const auto& children = file.model.nodes[node.node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open.push_back({static_cast<size_t>(*child), node.transform});
  }
  return placed;
}

}  // namespace hybray
