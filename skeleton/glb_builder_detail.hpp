// Binary glTF 2.0: a JSON that describes arrays, and the arrays.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace marrow::skeleton_detail {

/// Finite in single precision. Throws Error: Unsupported.
float as_float(double value);

/// The shortest text that reads back to the same float.
void append_float(std::string& text, float value);

/// Arrays, what describes them, and the mesh of them. The adders return the number of an accessor.
class GlbBuilder {
 public:
  enum Mode { Points = 0, Lines = 1, Triangles = 4 };

  std::size_t add_positions(const std::vector<Vec3>& points);
  std::size_t add_scalars(const std::vector<double>& values);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);
  std::size_t add_joints(const std::vector<std::array<std::uint16_t, 4>>& joints);
  std::size_t add_weights(const std::vector<std::array<float, 4>>& weights);
  /// By columns.
  std::size_t add_matrices(const std::vector<std::array<float, 16>>& matrices);
  void add_primitive(const std::string& attributes, std::size_t indices, Mode mode);

  /// What a scene has besides its mesh, which is node 0: pieces of JSON, each with a comma in
  /// front.
  struct Scene {
    std::string mesh_members, roots, nodes, members;
    std::string name = "skeleton";  ///< of node 0
  };
  /// The file; without a primitive there is nothing in it.
  std::string finish() const { return finish({}); }
  std::string finish(const Scene& scene) const;

 private:
  std::size_t add_accessor(std::size_t begin, int component, std::size_t count, const char* type,
                           const std::string& bounds);
  template <std::size_t N>
  std::size_t add_floats(const std::vector<std::array<float, N>>& rows, const char* type);

  std::string binary_, views_, accessors_, primitives_;
  std::size_t count_ = 0;
};

}  // namespace marrow::skeleton_detail
