// Test shapes whose centre lines are known: they are made from them.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <optional>
#include <span>
#include <string>

namespace marrow {

/// What the triangles of an analytic shape are.
enum class SurfaceKind {
  Closed,       ///< the closed 2-manifold boundary of the shape, one piece per component
  Overlapping,  ///< closed parts that run into each other, not welded
  Flat,         ///< a sheet without thickness, with a boundary
};

/// One line of `marrow make --list`, and what the skeleton of the shape must look like.
struct AnalyticShapeInfo {
  const char* name;
  const char* note;  ///< one line
  SurfaceKind surface;
  int components;
  int cycles;
  std::optional<int> leaves;  ///< none: it is a matter of taste
};

struct AnalyticShape {
  std::string name;
  std::string note;
  SurfaceKind surface = SurfaceKind::Closed;
  Shape shape;
  /// The exact centre lines; the radius is the distance from the surface (near joints, where limbs
  /// blend, a little less than that).
  CurveSkeleton truth;
  int components = 1;
  int cycles = 0;
  std::optional<int> leaves;
};

/// Coarser meshes would miss the thinnest parts; finer ones take minutes.
inline constexpr double kLeastResolution = 0.5;
inline constexpr double kMostResolution = 50;
inline constexpr int kMostPose = 1'000'000;

struct MakeOptions {
  double resolution = 1;  ///< factor on the number of faces
  int pose = 0;           ///< of bodies of bones: how their limbs are bent; 0: as they are
};

/// All shapes that make_analytic_shape() knows, in the order of this list.
std::span<const AnalyticShapeInfo> analytic_shapes();

/// Makes the shape `name`: the same numbers on every machine, multiples of 1e-6.
/// Throws Error: Usage (no such name: the message lists all; resolution or pose out of range; a
/// pose of a shape that is no tree of bones).
AnalyticShape make_analytic_shape(const std::string& name, const MakeOptions& options = {});

/// The truth as JSON: {"name", "kind", "note", "expected": {"components", "cycles", "tips": [least,
/// most]}, "graph_stats", "nodes": [[x, y, z, radius], ...], "edges": [{"a", "b", "polyline_xyzr":
/// [[x, y, z, radius], ...]}, ...]}. Nodes are the leaves and joints and one node of every cycle
/// without a joint; a polyline holds both of its ends.
std::string format_truth_json(const AnalyticShape& shape);

}  // namespace marrow
