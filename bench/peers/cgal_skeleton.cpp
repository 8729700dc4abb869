// CGAL's mean curvature flow skeleton with its default parameters, as a user would call it:
//   cgal_skeleton SHAPE.off OUT.obj
// Prints {"seconds": {"skeleton": user CPU}, ...}; reading and writing do not count. CGAL takes one
// closed component at a time, so each is skeletonised by itself. Exit status 3: CGAL cannot take
// this shape.
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>
#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Skeleton = CGAL::Mean_curvature_flow_skeletonization<Mesh>::Skeleton;

constexpr int kCannotTake = 3;

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

int refuse(const std::string& words) {
  std::fprintf(stderr, "cgal_skeleton: %s\n", words.c_str());
  return kCannotTake;
}

void write(const std::string& path, const std::vector<Skeleton>& parts) {
  std::ofstream out(path);
  out.precision(17);
  std::size_t first = 1;
  for (const Skeleton& part : parts) {
    for (const auto v : CGAL::make_range(vertices(part))) out << "v " << part[v].point << '\n';
    for (const auto e : CGAL::make_range(edges(part)))
      out << "l " << first + source(e, part) << ' ' << first + target(e, part) << '\n';
    first += num_vertices(part);
  }
}

int run(const std::string& shape_path, const std::string& out_path) {
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(shape_path, mesh) || mesh.is_empty())
    return refuse(shape_path + ": not the surface of a manifold");
  if (!CGAL::is_closed(mesh)) return refuse(shape_path + ": not closed");
  if (!CGAL::is_triangle_mesh(mesh)) return refuse(shape_path + ": not made of triangles");
  std::vector<Mesh> components;
  CGAL::Polygon_mesh_processing::split_connected_components(mesh, components);

  const double start = user_seconds();
  std::vector<Skeleton> parts(components.size());
  for (std::size_t i = 0; i < components.size(); ++i)
    CGAL::extract_mean_curvature_flow_skeleton(components[i], parts[i]);
  std::printf("{\"seconds\": {\"skeleton\": %.6f}, \"version\": \"CGAL %s\"}\n",
              user_seconds() - start, CGAL_STR(CGAL_VERSION));
  write(out_path, parts);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: cgal_skeleton SHAPE.off OUT.obj\n", stderr);
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& e) {
    return refuse(e.what());
  }
}
