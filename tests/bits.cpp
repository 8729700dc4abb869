// Prints a hash of every stage of the method for some shapes. What it prints must be the same from
// every compiler, at every optimisation level, on every machine and under the sanitizers; see
// scripts/check_bits.sh and golden/bits.txt. Runs on every instruction set that the machine has,
// and says where one of them differs.
#include <marrow/extract.hpp>
#include <marrow/silhouette.hpp>
#include <marrow/simd.hpp>
#include <marrow/skeleton_io.hpp>

#include <bit>
#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>

#include "analytic_shapes.hpp"

using namespace marrow;

namespace {

/// 64 bits of FNV-1a over everything added, byte by byte from the lowest.
class Hash {
 public:
  void add(std::unsigned_integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      value_ = (value_ ^ (static_cast<std::uint64_t>(value) >> (8 * i) & 0xff)) * 0x100000001b3;
  }
  void add(std::signed_integral auto value) { add(static_cast<std::uint64_t>(value)); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3& p) {
    add(p.x);
    add(p.y);
    add(p.z);
  }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint8_t>(c));
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

Hash hash_of(const Normalization& n) {
  Hash h;
  for (const Vec3& v : {n.center, n.axes.x, n.axes.y, n.axes.z}) h.add(v);
  h.add(n.prescale);
  h.add(n.radius);
  return h;
}

Hash hash_of_snapped(const NormalizedShape& shape, const std::vector<StereoImages>& views,
                     int resolution) {
  Hash h;
  for (const StereoImages& view : views) {
    for (const ViewImage* image : {&view.front, &view.side}) {
      const SnappedPoints snapped = snap(shape, image->plane, resolution);
      for (std::size_t i = 0; i < snapped.size(); ++i) h.add(std::int16_t(snapped.x(i)));
      for (std::size_t i = 0; i < snapped.size(); ++i) h.add(std::int16_t(snapped.y(i)));
    }
  }
  return h;
}

Hash hash_of(const std::vector<StereoImages>& views) {
  Hash h;
  for (const StereoImages& view : views) {
    for (const ViewImage* image : {&view.front, &view.side}) {
      for (const auto word : image->silhouette.words()) h.add(word);
      for (const auto distance : image->distance.pixels()) h.add(distance);
      for (const MedialPixel& pixel : image->axis.pixels()) h.add(pixel.x);
    }
  }
  return h;
}

Hash hash_of(const VoteGrid& grid) {
  Hash h;
  h.add(grid.grid.origin);
  h.add(grid.grid.size);
  for (const Vote& vote : grid.votes) {
    h.add(vote.voxel);
    h.add(vote.count);
    h.add(vote.radius);
    h.add(vote.support);
    h.add(vote.position);
  }
  return h;
}

Hash hash_of(const VoxelGrid& grid, const VoxelSet& set) {
  Hash h;
  for (std::uint32_t v = 0; v < grid.count(); ++v) h.add(static_cast<std::uint8_t>(set[v]));
  return h;
}

Hash hash_of(const VoteGraph& graph) {
  Hash h;
  for (const auto& node : graph.nodes) {
    h.add(node.position);
    h.add(node.radius);
    h.add(node.support);
  }
  for (const auto& [a, b] : graph.edges) {
    h.add(a);
    h.add(b);
  }
  return h;
}

Hash hash_of(const CurveSkeleton& skeleton) {
  Hash h;
  for (const auto& node : skeleton.nodes) {
    h.add(node.position);
    h.add(node.radius);
    h.add(node.section_radius);
  }
  for (const auto& [a, b] : skeleton.edges) {
    h.add(a);
    h.add(b);
  }
  return h;
}

Hash hash_of(std::string_view text) {
  Hash h;
  h.add(text);
  return h;
}

/// "shape stage hash", in the order of the stages.
using Lines = std::vector<std::string>;

void add_line(Lines& lines, const std::string& name, const char* stage, const Hash& hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash.value()));
  lines.push_back(name + ' ' + stage + ' ' + digits);
}

void add_stages(Lines& lines, const std::string& name) {
  const Shape shape = make_analytic_shape(name).shape;
  ExtractOptions options;
  options.image_resolution = 128;
  options.grid_resolution = 64;
  const ExtractTrace t = extract_with_trace(shape, options);
  const auto add = [&](const char* stage, const Hash& h) { add_line(lines, name, stage, h); };
  add("normalization", hash_of(t.normalization));
  add("snapped", hash_of_snapped(apply(t.normalization, shape), t.views, options.image_resolution));
  add("views", hash_of(t.views));
  add("votes", hash_of(t.votes));
  add("cleaned", hash_of(t.cleaned));
  add("tree", hash_of(t.tree));
  add("core", hash_of(t.core));
  add("solid", hash_of(t.votes.grid, t.solid));
  add("thinned", hash_of(t.thinned));
  add("collapsed", hash_of(t.collapsed));
  add("smoothed", hash_of(t.smoothed));
  add("refined", hash_of(t.refined));
  add("skeleton", hash_of(format_skeleton(t.skeleton, SkeletonFormat::Obj)));
}

Lines all_lines() {
  Lines lines;
  for (const char* name :
       {"tapered-capsule", "torus", "trefoil", "star-union", "gingerbread-man", "quadruped"})
    add_stages(lines, name);
  return lines;
}

}  // namespace

int main() {
  const Lines expected = all_lines();
  for (const std::string& line : expected) std::puts(line.c_str());
  for (const std::string& target : simd_targets()) {
    set_simd_target(target);
    const Lines lines = all_lines();
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i] != expected[i]) std::printf("on %s: %s\n", target.c_str(), lines[i].c_str());
  }
}
