// The Python module marrow: the library with arrays of numpy in place of shapes and skeletons.
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/shape_io.hpp>
#include <marrow/skeleton_io.hpp>
#include <marrow/volume_io.hpp>

#include <pybind11/stl.h>

#include <string>
#include <variant>

#include "arrays.hpp"
#include "skeleton_class.hpp"

namespace py = pybind11;

namespace marrow {

namespace {

using OptionalIndices = std::optional<Indices>;

SilhouetteMethod silhouettes_of(const std::string& name) {
  if (name == "scanline") return SilhouetteMethod::Scanline;
  if (name == "embree") return SilhouetteMethod::Embree;
  throw Error(ErrorKind::Usage, "silhouettes must be 'scanline' or 'embree'");
}

Refinement refinement_of(const std::string& name) {
  if (name == "none") return Refinement::None;
  if (name == "hull") return Refinement::Hull;
  if (name == "surface") return Refinement::Surface;
  throw Error(ErrorKind::Usage, "refine must be 'none', 'hull' or 'surface'");
}

Rules rules_of(const std::string& name) {
  if (name == "marrow") return Rules::Marrow;
  if (name == "paper") return Rules::Paper;
  throw Error(ErrorKind::Usage, "rules must be 'marrow' or 'paper'");
}

/// A number, 21 or 81, or an array of directions.
void set_views(ExtractOptions& options, const py::handle& views) {
  if (py::isinstance<py::int_>(views))
    options.views = views.cast<int>();
  else
    options.directions = shape_of(views.cast<Doubles>(), nullptr).points;
}

/// The keywords that every function which extracts takes.
ExtractOptions options_of(const py::kwargs& keywords) {
  ExtractOptions options;
  py::object progress = py::none();
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    if (name == "image")
      options.image_resolution = value.cast<int>();
    else if (name == "grid")
      options.grid_resolution = value.cast<int>();
    else if (name == "closing")
      options.closing = value.cast<double>();
    else if (name == "smoothing")
      options.smoothing_passes = value.cast<int>();
    else if (name == "silhouettes")
      options.silhouettes = silhouettes_of(value.cast<std::string>());
    else if (name == "refine")
      options.refinement = refinement_of(value.cast<std::string>());
    else if (name == "rules")
      options.rules = rules_of(value.cast<std::string>());
    else if (name == "views")
      set_views(options, value);
    else if (name == "threads")
      options.max_threads = value.cast<int>();
    else if (name == "progress")
      progress = py::reinterpret_borrow<py::object>(value);
    else
      throw py::type_error("unknown keyword '" + name + "'; help(marrow.extract) lists them");
  }
  options.on_stage = [progress](std::string_view stage, double done) {
    const py::gil_scoped_acquire gil;
    // Between stages a signal (Ctrl-C) may end the work, and so may what `progress` raises.
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(std::string(stage), done);
  };
  return options;
}

template <class Input>
CurveSkeleton extract_free(const Input& input, const py::kwargs& keywords) {
  const ExtractOptions options = options_of(keywords);
  const py::gil_scoped_release free;
  return extract(input, options);
}

Vec3 vec3_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

/// A file as `marrow extract` takes it: a volume, a shape or a point cloud.
std::variant<Shape, Volume> read_any(const std::string& path, double iso) {
  const py::gil_scoped_release free;
  VolumeOptions options;
  options.iso = iso;
  if (volume_format_of(path)) return read_volume(path, options);
  return read_shape(path);
}

py::tuple read_shape_arrays(const std::string& path) {
  Shape shape;
  {
    const py::gil_scoped_release free;
    shape = read_shape(path);
  }
  const auto rows = [](std::size_t n) { return static_cast<py::ssize_t>(n); };
  py::array_t<double> points({rows(shape.points.size()), py::ssize_t{3}});
  py::array_t<std::uint32_t> faces({rows(shape.triangles.size()), py::ssize_t{3}});
  auto to = points.mutable_unchecked<2>();
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const Vec3& p = shape.points[i];
    to(rows(i), 0) = p.x, to(rows(i), 1) = p.y, to(rows(i), 2) = p.z;
  }
  auto corner = faces.mutable_unchecked<2>();
  for (std::size_t i = 0; i < shape.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) corner(rows(i), rows(k)) = shape.triangles[i][k];
  return py::make_tuple(points, faces);
}

/// marrow.Error, a RuntimeError with the attributes `kind` and `status`.
void bind_error(py::module_& m) {
  static py::exception<Error> type(m, "Error", PyExc_RuntimeError);
  type.doc() =
      "What went wrong. kind: 'usage', 'malformed', ...; status: the exit status that the program\n"
      "marrow has for it.";
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the type is pybind11's
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& e) {
      py::object instance = py::reinterpret_borrow<py::object>(type)(e.what());
      instance.attr("kind") = name_of(e.kind());
      instance.attr("status") = static_cast<int>(e.kind());
      PyErr_SetObject(type.ptr(), instance.ptr());
    }
  });
}

void bind_extractions(py::module_& m) {
  m.def(
      "extract",
      [](const Doubles& vertices, const OptionalIndices& faces, const py::kwargs& keywords) {
        return extract_free(shape_of(vertices, faces ? &*faces : nullptr), keywords);
      },
      py::arg("vertices"), py::arg("faces") = py::none(),
      "The curve-skeleton of a mesh or, without faces, of a point cloud.\n\n"
      "vertices: n x 3. faces: m x 3 indices, or m x k for polygons of k corners. Any triangle\n"
      "soup will do; normals are not needed. Keywords:\n\n"
      "image: pixels along a side of each silhouette, 64 to 1024; 0: 256, or 512 for thin parts.\n"
      "grid: voxels along the longest side, 16 to 256.\n"
      "closing: of clouds, radius in pixels that gaps are closed by; 0: by the points' density.\n"
      "smoothing: passes. silhouettes: 'scanline' or 'embree'.\n"
      "refine: 'surface' for lines and radii put right on the surface of a mesh, 'hull' for radii\n"
      "of the visual hull, 'none' for those of the matches.\n"
      "rules: 'marrow', or 'paper' to compare with.\n"
      "views: 21 or 81 directions, or an array of n x 3.\n"
      "threads: at most, 0 for all; the result does not depend on it.\n"
      "progress: called as progress(stage, done) with done from 0 to 1; may raise to stop.\n\n"
      "Other Python threads run meanwhile. Raises marrow.Error.");
  m.def(
      "extract_volume",
      [](const py::array& values, double iso, const std::array<double, 3>& spacing,
         const std::array<double, 3>& origin, const py::kwargs& keywords) {
        return extract_free(volume_of(values, iso, vec3_of(spacing), vec3_of(origin)), keywords);
      },
      py::arg("values"), py::arg("iso") = 0.0, py::arg("spacing") = std::array<double, 3>{1, 1, 1},
      py::arg("origin") = std::array<double, 3>{0, 0, 0},
      "The curve-skeleton of the voxels of an array, indexed [x, y, z], whose values are greater\n"
      "than iso. The centre of voxel (i, j, k) is at origin + spacing * (i, j, k). The array is\n"
      "read where it is, whatever its strides. The other keywords are those of extract().");
  m.def(
      "extract_file",
      [](const py::object& path, double iso, const py::kwargs& keywords) {
        return std::visit([&](const auto& any) { return extract_free(any, keywords); },
                          read_any(path_of(path), iso));
      },
      py::arg("path"), py::arg("iso") = 0.0,
      "The curve-skeleton of a shape, point cloud or volume in a file; its extension names its\n"
      "format. iso is for volumes; the other keywords are those of extract().");
}

}  // namespace

}  // namespace marrow

PYBIND11_MODULE(_marrow, m) {
  using namespace marrow;
  m.attr("__version__") = MARROW_VERSION;
  bind_error(m);
  bind_skeleton(m);
  bind_extractions(m);
  m.def(
      "load", [](const py::object& path) { return read_skeleton(path_of(path)); }, py::arg("path"),
      "Reads a skeleton; the extension names the format.");
  m.def(
      "read_shape", [](const py::object& path) { return read_shape_arrays(path_of(path)); },
      py::arg("path"),
      "Reads a mesh or a point cloud: (vertices, faces), arrays of n x 3 and m x 3; of a cloud m "
      "is\n"
      "0. Polygons are cut into triangles.");
}
