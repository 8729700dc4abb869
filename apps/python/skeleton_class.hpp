// The class marrow.Skeleton.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace marrow {

void bind_skeleton(pybind11::module_& m);

/// A str or os.PathLike as a path.
std::string path_of(const pybind11::object& path);

}  // namespace marrow
