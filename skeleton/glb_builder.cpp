#include <marrow/error.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "glb_builder_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr int kFloat = 5126, kUnsigned = 5125, kShort = 5123;

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(static_cast<unsigned char>(word >> shift));
}

std::string list(const std::array<float, 3>& values) {
  std::string text;
  for (const float v : values) {
    text += text.empty() ? '[' : ',';
    append_float(text, v);
  }
  return text + "]";
}

void append_item(std::string& items, const std::string& item) {
  if (!items.empty()) items += ',';
  items += item;
}

void append_chunk(std::string& file, std::string_view kind, const std::string& chunk) {
  append_word(file, static_cast<std::uint32_t>(chunk.size()));
  file += kind;
  file += chunk;
}

}  // namespace

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

std::size_t GlbBuilder::add_positions(const std::vector<Vec3>& points) {
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

std::size_t GlbBuilder::add_scalars(const std::vector<double>& values) {
  const std::size_t begin = binary_.size();
  for (const double v : values) append_word(binary_, std::bit_cast<std::uint32_t>(as_float(v)));
  return add_accessor(begin, kFloat, values.size(), "SCALAR", "");
}

std::size_t GlbBuilder::add_indices(const std::vector<std::uint32_t>& indices) {
  const std::size_t begin = binary_.size();
  for (const std::uint32_t i : indices) append_word(binary_, i);
  return add_accessor(begin, kUnsigned, indices.size(), "SCALAR", "");
}

std::size_t GlbBuilder::add_joints(const std::vector<std::array<std::uint16_t, 4>>& joints) {
  const std::size_t begin = binary_.size();
  for (const auto& [a, b, c, d] : joints) {
    append_word(binary_, std::uint32_t{b} << 16 | a);
    append_word(binary_, std::uint32_t{d} << 16 | c);
  }
  return add_accessor(begin, kShort, joints.size(), "VEC4", "");
}

template <std::size_t N>
std::size_t GlbBuilder::add_floats(const std::vector<std::array<float, N>>& rows,
                                   const char* type) {
  const std::size_t begin = binary_.size();
  for (const auto& row : rows)
    for (const float v : row) append_word(binary_, std::bit_cast<std::uint32_t>(v));
  return add_accessor(begin, kFloat, rows.size(), type, "");
}

std::size_t GlbBuilder::add_weights(const std::vector<std::array<float, 4>>& weights) {
  return add_floats(weights, "VEC4");
}

std::size_t GlbBuilder::add_matrices(const std::vector<std::array<float, 16>>& matrices) {
  return add_floats(matrices, "MAT4");
}

void GlbBuilder::add_primitive(const std::string& attributes, std::size_t indices, Mode mode) {
  append_item(primitives_, R"({"attributes":)" + attributes + R"(,"indices":)" +
                               std::to_string(indices) + R"(,"mode":)" + std::to_string(mode) +
                               "}");
}

std::string GlbBuilder::finish(const Scene& scene) const {
  std::string json = R"({"asset":{"version":"2.0","generator":"marrow"},"scene":0,"scenes":[{)";
  if (primitives_.empty()) {
    json += "}]}";
  } else {
    json += R"("nodes":[0)" + scene.roots + R"(]}],"nodes":[{"name":")" + scene.name +
            R"(","mesh":0)" + scene.mesh_members + "}" + scene.nodes +
            R"(],"meshes":[{"primitives":[)" + primitives_ + R"(]}],"accessors":[)" + accessors_ +
            R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{"byteLength":)" +
            std::to_string(binary_.size()) + "}]" + scene.members + "}";
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

std::size_t GlbBuilder::add_accessor(std::size_t begin, int component, std::size_t count,
                                     const char* type, const std::string& bounds) {
  append_item(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
                          std::to_string(binary_.size() - begin) + "}");
  append_item(accessors_, R"({"bufferView":)" + std::to_string(count_) + R"(,"componentType":)" +
                              std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                              R"(,"type":")" + type + "\"" + bounds + "}");
  return count_++;
}

}  // namespace marrow::skeleton_detail
