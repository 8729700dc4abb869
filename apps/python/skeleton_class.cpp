#include "skeleton_class.hpp"

#include <marrow/curve_skeleton.hpp>
#include <marrow/error.hpp>
#include <marrow/parts.hpp>
#include <marrow/skeleton_io.hpp>
#include <marrow/surface_map.hpp>

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <optional>

#include "arrays.hpp"

namespace py = pybind11;

namespace marrow {

namespace {

using Node = CurveSkeleton::Node;
using OptionalDoubles = std::optional<Doubles>;

py::ssize_t signed_size(std::size_t n) { return static_cast<py::ssize_t>(n); }

/// An array that shows memory of the skeleton `self`, keeps it alive and cannot be written to.
template <class Value>
py::array view(const py::object& self, const Value* data, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides) {
  py::array array(py::dtype::of<Value>(), std::move(shape), std::move(strides), data, self);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A member of all nodes, from `first` on, as a column or as rows of `columns`.
py::array node_view(const py::object& self, const double Node::*first) {
  const auto& nodes = self.cast<const CurveSkeleton&>().nodes;
  static const Node none;
  const Node* begin = nodes.empty() ? &none : nodes.data();
  return view(self, &(begin->*first), {signed_size(nodes.size())}, {sizeof(Node)});
}

py::array positions(const py::object& self) {
  const auto& nodes = self.cast<const CurveSkeleton&>().nodes;
  static const Node none;
  const Node* begin = nodes.empty() ? &none : nodes.data();
  return view(self, &begin->position.x, {signed_size(nodes.size()), 3},
              {sizeof(Node), sizeof(double)});
}

py::array edges(const py::object& self) {
  const auto& all = self.cast<const CurveSkeleton&>().edges;
  static const CurveSkeleton::Edge none{};
  const CurveSkeleton::Edge* begin = all.empty() ? &none : all.data();
  return view(self, begin->data(), {signed_size(all.size()), 2},
              {sizeof(CurveSkeleton::Edge), sizeof(NodeId)});
}

py::list branch_arrays(const CurveSkeleton& skeleton) {
  py::list result;
  for (const Branch& branch : branches(skeleton))
    result.append(py::array_t<NodeId>(signed_size(branch.nodes.size()), branch.nodes.data()));
  return result;
}

py::object to_networkx(const CurveSkeleton& skeleton) {
  py::object graph = py::module_::import("networkx").attr("Graph")();
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const Node& n = skeleton.nodes[i];
    graph.attr("add_node")(
        i, py::arg("pos") = py::make_tuple(n.position.x, n.position.y, n.position.z),
        py::arg("radius") = n.radius, py::arg("section_radius") = n.section_radius);
  }
  for (const auto& [a, b] : skeleton.edges)
    graph.attr("add_edge")(
        a, b, py::arg("length") = distance(skeleton.nodes[a].position, skeleton.nodes[b].position));
  return graph;
}

std::string words_of(const CurveSkeleton& s) {
  return "<marrow.Skeleton: " + std::to_string(s.nodes.size()) + " nodes, components " +
         std::to_string(component_count(s)) + ", cycles " + std::to_string(cycle_count(s)) +
         ", leaves " + std::to_string(leaf_count(s)) + ", joints " +
         std::to_string(joint_count(s)) + ">";
}

void bind_making(py::class_<CurveSkeleton>& type) {
  type.def(py::init([](const Doubles& nodes, const Doubles& radii, const Indices& edges,
                       const OptionalDoubles& section_radii) {
             return skeleton_of(nodes, radii, edges, section_radii ? &*section_radii : nullptr);
           }),
           py::arg("nodes"), py::arg("radii"), py::arg("edges"),
           py::arg("section_radii") = py::none(),
           "A skeleton of nodes (n x 3), radii (n) and edges (m x 2); an edge that is given twice\n"
           "counts once.");
  type.def(py::pickle(
      [](const py::object& self) {
        return py::make_tuple(positions(self), node_view(self, &Node::radius), edges(self),
                              node_view(self, &Node::section_radius));
      },
      [](const py::tuple& state) {
        const auto sections = state[3].cast<Doubles>();
        return skeleton_of(state[0].cast<Doubles>(), state[1].cast<Doubles>(),
                           state[2].cast<Indices>(), &sections);
      }));
}

/// {"node", "branch", "part"}: an array of numbers for each, by `place(i)` of `count` places.
template <class PlaceOf>
py::dict map_arrays(const std::vector<py::ssize_t>& shape, std::size_t count, PlaceOf place) {
  py::dict result;
  const auto add = [&](const char* name, auto number) {
    py::array_t<std::int64_t> array(shape);
    std::int64_t* to = array.mutable_data();
    for (std::size_t i = 0; i < count; ++i) {
      const SurfaceMap::Place* at = place(i);
      to[i] = at ? static_cast<std::int64_t>(number(*at)) : -1;
    }
    result[name] = array;
  };
  add("node", [](const auto& at) { return at.node; });
  add("branch", [](const auto& at) { return at.branch; });
  add("part", [](const auto& at) { return at.part; });
  return result;
}

py::dict map_of(const CurveSkeleton& skeleton, const Doubles& vertices,
                const std::optional<Indices>& faces) {
  const Shape shape = shape_of(vertices, faces ? &*faces : nullptr);
  SurfaceMap map;
  {
    const py::gil_scoped_release free;
    map = map_surface(shape, skeleton);
  }
  // Polygons that cross themselves have added points behind those that were given.
  const auto count = static_cast<std::size_t>(vertices.shape(0));
  return map_arrays({vertices.shape(0)}, count, [&](std::size_t i) { return &map.places[i]; });
}

py::dict volume_map_of(const CurveSkeleton& skeleton, const py::array& values, double iso,
                       const std::array<double, 3>& spacing, const std::array<double, 3>& origin) {
  const Volume volume = volume_of(values, iso, {spacing[0], spacing[1], spacing[2]},
                                  {origin[0], origin[1], origin[2]});
  SurfaceMap map;
  {
    const py::gil_scoped_release free;
    map = map_surface(volume, skeleton);
  }
  // Places run along x first, the arrays along z.
  std::vector<const SurfaceMap::Place*> places(static_cast<std::size_t>(values.size()), nullptr);
  std::size_t next = 0;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x)
        if (volume(x, y, z))
          places[static_cast<std::size_t>(
              (static_cast<std::int64_t>(x) * volume.ny + y) * volume.nz + z)] =
              &map.places[next++];
  return map_arrays({values.shape(0), values.shape(1), values.shape(2)}, places.size(),
                    [&](std::size_t i) { return places[i]; });
}

void bind_maps(py::class_<CurveSkeleton>& type) {
  type.def("map", map_of, py::arg("vertices"), py::arg("faces") = py::none(),
           "Which node, branch and part every vertex, or point of a cloud, belongs to: a dict of\n"
           "arrays 'node', 'branch' and 'part'. Nothing is mapped across a gap.");
  type.def("map_volume", volume_map_of, py::arg("values"), py::arg("iso") = 0.0,
           py::arg("spacing") = std::array<double, 3>{1, 1, 1},
           py::arg("origin") = std::array<double, 3>{0, 0, 0},
           "The same for voxels, as arrays of the shape of values; -1 in the background.");
}

void bind_graph(py::class_<CurveSkeleton>& type) {
  type.def_property_readonly("nodes", positions, "Positions, n x 3, in the units of the shape.");
  type.def_property_readonly(
      "radii", [](const py::object& self) { return node_view(self, &Node::radius); },
      "Radii of the inscribed balls, n.");
  type.def_property_readonly(
      "section_radii",
      [](const py::object& self) { return node_view(self, &Node::section_radius); },
      "Radii of the balls that stand for the sections, n; 0 where they are not known.");
  type.def_property_readonly("edges", edges, "Indices of nodes, m x 2, lower one first, sorted.");
  type.def_property_readonly(
      "branches", branch_arrays,
      "Chains of nodes from a leaf or joint to the next, as arrays of indices; a cycle without a\n"
      "joint repeats its first node.");
  type.def_property_readonly("components", component_count, "Connected parts.");
  type.def_property_readonly("cycles", cycle_count, "Independent cycles.");
  type.def_property_readonly("leaves", leaf_count, "Nodes with one edge.");
  type.def_property_readonly("joints", joint_count, "Nodes with three edges or more.");
  type.def_property_readonly("length", total_length, "Of all edges.");
  type.def_property_readonly(
      "degrees",
      [](const CurveSkeleton& s) {
        const std::vector<int> all = degrees(s);
        return py::array_t<int>(signed_size(all.size()), all.data());
      },
      "Edges at every node, n.");
}

}  // namespace

std::string path_of(const py::object& path) {
  return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

void bind_skeleton(py::module_& m) {
  py::class_<CurveSkeleton> type(m, "Skeleton",
                                 "A curve-skeleton: centre lines with the radius of a ball at\n"
                                 "every node. Its arrays show its memory and are read-only.");
  bind_making(type);
  bind_graph(type);
  bind_maps(type);
  type.def(
      "save",
      [](const CurveSkeleton& s, const py::object& path) { write_skeleton(path_of(path), s); },
      py::arg("path"), "Writes a file, whole or not at all; the extension names the format.");
  type.def("to_networkx", to_networkx,
           "A networkx.Graph; nodes have pos, radius and section_radius, edges length.");
  type.def("largest_part", largest_part, "The part with the longest lines.");
  type.def("large_parts", large_parts, py::arg("share"),
           "The parts of at least this share (0 to 1) of the longest one's lines.");
  type.def("__len__", [](const CurveSkeleton& s) { return s.nodes.size(); });
  type.def("__repr__", words_of);
  type.def(py::self == py::self);
}

}  // namespace marrow
