#include <marrow/error.hpp>
#include <marrow/volume_surface.hpp>

#include <array>
#include <bit>
#include <string>

#include "volume_rows_detail.hpp"

namespace marrow {

namespace {

using volume_detail::Row;
using volume_detail::Rows;
using volume_detail::Word;

constexpr std::size_t kMostTriangles = 100'000'000;

/// Of 64 voxels those with a face, by direction: -x, +x, -y, +y, -z, +z.
using FaceWords = std::array<Word, 6>;

/// Calls `visit(i, y, z, faces)` for every word of foreground with a face; i counts words.
template <class Visit>
void for_each_face_word(const Volume& volume, const Visit& visit) {
  const Rows rows(volume);
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y) {
      const Row row = rows(y, z), y0 = rows(y - 1, z), y1 = rows(y + 1, z), z0 = rows(y, z - 1),
                z1 = rows(y, z + 1);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Word w = row[i];
        if (w == 0) continue;
        const FaceWords faces{w & ~volume_detail::shifted_up(row, i),
                              w & ~volume_detail::shifted_down(row, i),
                              w & ~y0[i],
                              w & ~y1[i],
                              w & ~z0[i],
                              w & ~z1[i]};
        visit(i, y, z, faces);
      }
    }
}

/// Calls `visit(x)` for every bit of word `i` of a row.
template <class Visit>
void for_each_bit(Word word, std::size_t i, const Visit& visit) {
  for (; word != 0; word &= word - 1) visit(static_cast<int>(i * 64) + std::countr_zero(word));
}

/// Gives every corner of voxels one point; knows the two layers of corners around one of voxels.
class Corners {
 public:
  Corners(const Volume& volume, std::vector<Vec3>& points)
      : volume_(volume), points_(points), width_(static_cast<std::size_t>(volume.nx) + 1) {
    const std::size_t count = width_ * (static_cast<std::size_t>(volume.ny) + 1);
    for (Layer& layer : layers_) layer.number.assign(count, kNone);
  }

  void go_to_layer(int z) {
    if (z == z_) return;
    // Of the next layer of voxels the upper corners are the lower ones; others are new.
    if (z == z_ + 1) std::swap(layers_[0], layers_[1]);
    if (z != z_ + 1) layers_[0].clear();
    layers_[1].clear();
    z_ = z;
  }

  std::uint32_t point(int x, int y, int z) {
    Layer& layer = layers_[static_cast<std::size_t>(z - z_)];
    const std::size_t at = static_cast<std::size_t>(x) + width_ * static_cast<std::size_t>(y);
    std::uint32_t& number = layer.number[at];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(points_.size());
      layer.used.push_back(at);
      points_.push_back(volume_.to_world({x - 0.5, y - 0.5, z - 0.5}));
    }
    return number;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct Layer {
    std::vector<std::uint32_t> number;
    std::vector<std::size_t> used;

    void clear() {
      for (const std::size_t at : used) number[at] = kNone;
      used.clear();
    }
  };

  const Volume& volume_;
  std::vector<Vec3>& points_;
  std::size_t width_;
  std::array<Layer, 2> layers_;
  int z_ = -2;
};

/// Corners of the face of voxel (0, 0, 0) in each direction, seen from outside counter-clockwise.
constexpr std::array<std::array<std::array<int, 3>, 4>, 6> kFaces{{
    {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
    {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}},
    {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
    {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}},
    {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}},
    {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
}};

}  // namespace

std::size_t boundary_face_count(const Volume& volume) {
  std::size_t count = 0;
  for_each_face_word(volume, [&](std::size_t, int, int, const FaceWords& faces) {
    for (const Word w : faces)
      if (w != 0) count += static_cast<std::size_t>(std::popcount(w));  // most are inside
  });
  return count;
}

Shape boundary_surface(const Volume& volume) {
  const std::size_t triangles = 2 * boundary_face_count(volume);
  if (triangles > kMostTriangles)
    throw Error(ErrorKind::Limit, "the boundary of the volume has " + std::to_string(triangles) +
                                      " triangles, more than " + std::to_string(kMostTriangles) +
                                      "; smooth or coarsen it");
  const bool is_mirrored = dot(volume.steps[0], cross(volume.steps[1], volume.steps[2])) < 0;
  Shape shape;
  shape.triangles.reserve(triangles);
  shape.points.reserve(triangles / 2 + 2);
  Corners corners(volume, shape.points);
  for_each_face_word(volume, [&](std::size_t i, int y, int z, const FaceWords& faces) {
    corners.go_to_layer(z);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for_each_bit(faces[f], i, [&](int x) {
        std::array<std::uint32_t, 4> p{};
        for (std::size_t c = 0; c < 4; ++c) {
          const auto [dx, dy, dz] = kFaces[f][is_mirrored ? 3 - c : c];
          p[c] = corners.point(x + dx, y + dy, z + dz);
        }
        shape.triangles.push_back({p[0], p[1], p[2]});
        shape.triangles.push_back({p[0], p[2], p[3]});
      });
  });
  return shape;
}

}  // namespace marrow
