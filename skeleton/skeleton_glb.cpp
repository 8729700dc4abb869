// Binary glTF 2.0, for Blender and browsers: a JSON that describes arrays, and the arrays.
#include <marrow/capsule_mesh.hpp>
#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

enum Mode { Points = 0, Lines = 1, Triangles = 4 };

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(static_cast<unsigned char>(word >> shift));
}

float as_float(double value) {
  if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    throw Error(ErrorKind::Unsupported,
                "a coordinate is beyond what a .glb can hold; use another format");
  return static_cast<float>(value);
}

void append_float(std::string& text, float value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Arrays of four-byte numbers, what describes them, and the meshes of them.
class Builder {
 public:
  /// Returns the number of the accessor.
  std::size_t add_positions(const std::vector<Vec3>& points) {
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    const std::size_t begin = binary_.size();
    for (const Vec3& p : points) {
      const std::array<float, 3> xyz = {as_float(p.x), as_float(p.y), as_float(p.z)};
      for (std::size_t i = 0; i < 3; ++i) {
        append_word(binary_, std::bit_cast<std::uint32_t>(xyz[i]));
        low[i] = std::min(low[i], xyz[i]);
        high[i] = std::max(high[i], xyz[i]);
      }
    }
    return add_accessor(begin, kFloat, points.size(), "VEC3",
                        R"(,"min":)" + list(low) + R"(,"max":)" + list(high));
  }
  std::size_t add_scalars(const std::vector<double>& values) {
    const std::size_t begin = binary_.size();
    for (const double v : values) append_word(binary_, std::bit_cast<std::uint32_t>(as_float(v)));
    return add_accessor(begin, kFloat, values.size(), "SCALAR", "");
  }
  std::size_t add_indices(const std::vector<std::uint32_t>& indices) {
    const std::size_t begin = binary_.size();
    for (const std::uint32_t i : indices) append_word(binary_, i);
    return add_accessor(begin, kUnsigned, indices.size(), "SCALAR", "");
  }
  void add_primitive(const std::string& attributes, std::size_t indices, Mode mode) {
    append_item(primitives_, R"({"attributes":)" + attributes + R"(,"indices":)" +
                                 std::to_string(indices) + R"(,"mode":)" + std::to_string(mode) +
                                 "}");
  }
  std::string finish() const {
    std::string json = R"({"asset":{"version":"2.0","generator":"marrow"},"scene":0,"scenes":[{)";
    if (primitives_.empty()) {
      json += "}]}";
    } else {
      json += R"("nodes":[0]}],"nodes":[{"name":"skeleton","mesh":0}],"meshes":[{"primitives":[)" +
              primitives_ + R"(]}],"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
              R"(],"buffers":[{"byteLength":)" + std::to_string(binary_.size()) + "}]}";
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string body;
    append_chunk(body, "JSON", json);
    if (!binary_.empty()) append_chunk(body, std::string_view("BIN\0", 4), binary_);
    std::string file = "glTF";
    append_word(file, 2);
    append_word(file, static_cast<std::uint32_t>(body.size() + 12));
    return file + body;
  }

 private:
  static constexpr int kFloat = 5126, kUnsigned = 5125;

  static std::string list(const std::array<float, 3>& values) {
    std::string text;
    for (const float v : values) {
      text += text.empty() ? '[' : ',';
      append_float(text, v);
    }
    return text + "]";
  }
  static void append_item(std::string& items, const std::string& item) {
    if (!items.empty()) items += ',';
    items += item;
  }
  static void append_chunk(std::string& file, std::string_view kind, const std::string& chunk) {
    append_word(file, static_cast<std::uint32_t>(chunk.size()));
    file += kind;
    file += chunk;
  }
  std::size_t add_accessor(std::size_t begin, int component, std::size_t count, const char* type,
                           const std::string& bounds) {
    append_item(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(begin) +
                            R"(,"byteLength":)" + std::to_string(binary_.size() - begin) + "}");
    append_item(accessors_, R"({"bufferView":)" + std::to_string(count_) + R"(,"componentType":)" +
                                std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                                R"(,"type":")" + type + "\"" + bounds + "}");
    return count_++;
  }

  std::string binary_, views_, accessors_, primitives_;
  std::size_t count_ = 0;
};

/// The nodes without an edge.
std::vector<std::uint32_t> lone_nodes(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  std::vector<std::uint32_t> lone;
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) lone.push_back(n);
  return lone;
}

}  // namespace

std::string format_glb(const CurveSkeleton& skeleton) {
  Builder glb;
  if (skeleton.nodes.empty()) return glb.finish();
  std::vector<Vec3> points;
  std::vector<double> radii, sections;
  for (const auto& node : skeleton.nodes) {
    points.push_back(node.position);
    radii.push_back(node.radius);
    sections.push_back(node.section_radius);
  }
  std::string attributes = R"({"POSITION":)" + std::to_string(glb.add_positions(points)) +
                           R"(,"_RADIUS":)" + std::to_string(glb.add_scalars(radii));
  if (has_section_radii(skeleton))
    attributes += R"(,"_SECTION_RADIUS":)" + std::to_string(glb.add_scalars(sections));
  attributes += '}';
  std::vector<std::uint32_t> ends;
  for (const auto& e : skeleton.edges) ends.insert(ends.end(), e.begin(), e.end());
  if (!ends.empty()) glb.add_primitive(attributes, glb.add_indices(ends), Mode::Lines);
  const auto lone = lone_nodes(skeleton);
  if (!lone.empty()) glb.add_primitive(attributes, glb.add_indices(lone), Mode::Points);
  return glb.finish();
}

}  // namespace marrow::skeleton_detail

namespace marrow {

std::string format_glb(const Shape& mesh) {
  using namespace skeleton_detail;
  Builder glb;
  if (mesh.triangles.empty()) return glb.finish();
  const std::size_t positions = glb.add_positions(mesh.points);
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  glb.add_primitive(R"({"POSITION":)" + std::to_string(positions) + "}", glb.add_indices(corners),
                    Mode::Triangles);
  return glb.finish();
}

}  // namespace marrow
