// A page that shows a shape and the lines in it, whole in one file (marrow view).
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <string>
#include <vector>

namespace marrow {

/// Lines to be shown, and what they are called.
struct ViewLines {
  std::string name;
  CurveSkeleton skeleton;
};

struct ViewContent {
  std::string title;
  Shape shape;
  std::vector<ViewLines> lines;  ///< the skeleton, then stages on the way to it
};

/// HTML of its own, in one file: it loads nothing, and shows the words of names as they are. Shapes
/// of more than about 100,000 triangles are shown coarser. Any legal input works: flat, empty
/// lines, no shape. The same input gives the same bytes.
std::string view_page(const ViewContent& content);

}  // namespace marrow
