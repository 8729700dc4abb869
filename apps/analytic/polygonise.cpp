#include "polygonise.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "dual_cell.hpp"

namespace marrow {
namespace {

constexpr int kBlock = 4;                 // cells along a block
constexpr int kCorners = kBlock + 1;      // grid corners along a block
constexpr double kMargin = 1.5;           // cells that a vertex may move
constexpr double kHalfDiagonal = 0.8661;  // of a unit cube, rounded up

struct Cell {
  int x = 0, y = 0, z = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

struct Block {
  Cell first;
  std::shared_ptr<const Field> field;  ///< what matters in and around the block
};

/// A cell that the surface passes through.
struct CrossedCell {
  Cell at;
  int mask = 0;             ///< corners inside
  std::uint32_t first = 0;  ///< vertex of its first sheet
};

struct Vertex {
  Vec3 position;
  std::uint32_t block = 0;
};

using Polygon = std::vector<std::uint32_t>;

int bit(int number, int at) { return number >> at & 1; }

Cell moved(Cell c, int axis, int by) {
  (axis == 0 ? c.x : axis == 1 ? c.y : c.z) += by;
  return c;
}

class Polygoniser {
 public:
  Polygoniser(const Field& field, const Box& box, double cell) : cell_(cell) {
    const Vec3 size = box.high - box.low;
    const double longest = std::max({size.x, size.y, size.z}) + 4 * cell;
    int width = kBlock;
    while (width * cell < longest) width *= 2;
    const double half = width * cell / 2;
    origin_ = (box.low + box.high) / 2 - Vec3{half, half, half};
    collect_blocks(field, {}, width);
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) sample(i);
    std::sort(cells_.begin(), cells_.end(),
              [](const CrossedCell& a, const CrossedCell& b) { return a.at < b.at; });
    for (const CrossedCell& c : cells_) add_polygons(c);
  }

  Shape finish() {
    for (Vertex& v : vertices_) project(v);
    for (int i = 0; i < 3; ++i) spread_vertices();
    return triangulated();
  }

 private:
  Vec3 place(double x, double y, double z) const { return origin_ + Vec3{x, y, z} * cell_; }

  /// Descends to the blocks that the surface may cross.
  void collect_blocks(const Field& field, const Cell& first, int width) {
    const double half = width / 2.0;
    const Vec3 centre = place(first.x + half, first.y + half, first.z + half);
    const double radius = width * kHalfDiagonal * cell_;
    const FieldRange range = field.range(centre, radius);
    if (range.low > 0 || range.high < 0) return;
    const auto near = field.near(centre, radius + kMargin * cell_);
    if (width == kBlock) {
      blocks_.push_back({first, near});
      return;
    }
    const int step = width / 2;
    for (int i = 0; i < 8; ++i) {
      const Cell child{first.x + step * bit(i, 0), first.y + step * bit(i, 1),
                       first.z + step * bit(i, 2)};
      collect_blocks(*near, child, step);
    }
  }

  /// Finds the crossed cells of a block and puts a vertex on each of their sheets.
  void sample(std::uint32_t block_id) {
    const Block& block = blocks_[block_id];
    std::vector<double> values;
    values.reserve(kCorners * kCorners * kCorners);
    for (int z = 0; z < kCorners; ++z) {
      for (int y = 0; y < kCorners; ++y) {
        for (int x = 0; x < kCorners; ++x) {
          const Cell& c = block.first;
          values.push_back(block.field->value(place(c.x + x, c.y + y, c.z + z)));
        }
      }
    }
    for (int z = 0; z < kBlock; ++z) {
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) sample_cell(block_id, {x, y, z}, values);
      }
    }
  }

  void sample_cell(std::uint32_t block_id, const Cell& local, const std::vector<double>& values) {
    std::array<double, 8> corner{};
    int mask = 0;
    for (int i = 0; i < 8; ++i) {
      const int at =
          ((local.z + bit(i, 2)) * kCorners + local.y + bit(i, 1)) * kCorners + local.x + bit(i, 0);
      const double value = values[static_cast<std::size_t>(at)];
      corner[static_cast<std::size_t>(i)] = value;
      mask |= (value < 0 ? 1 : 0) << i;
    }
    if (mask == 0 || mask == 255) return;
    const Cell& first = blocks_[block_id].first;
    const Cell at{first.x + local.x, first.y + local.y, first.z + local.z};
    cells_.push_back({at, mask, static_cast<std::uint32_t>(vertices_.size())});
    append_vertices(cells_.back(), corner, block_id);
  }

  /// One vertex for each sheet, in the middle of its crossings.
  void append_vertices(const CrossedCell& cell, const std::array<double, 8>& value,
                       std::uint32_t block_id) {
    const CellSheets& sheets = cell_sheets()[static_cast<std::size_t>(cell.mask)];
    std::array<Vec3, 4> sum{};
    std::array<int, 4> count{};
    for (int a = 0; a < 8; ++a) {
      for (int axis = 0; axis < 3; ++axis) {
        const int b = a | 1 << axis;
        if (b == a || bit(cell.mask, a) == bit(cell.mask, b)) continue;
        const double va = value[static_cast<std::size_t>(a)];
        const double vb = value[static_cast<std::size_t>(b)];
        Vec3 at{static_cast<double>(bit(a, 0)), static_cast<double>(bit(a, 1)),
                static_cast<double>(bit(a, 2))};
        (axis == 0 ? at.x : axis == 1 ? at.y : at.z) = va / (va - vb);
        const auto sheet = static_cast<std::size_t>(
            sheets.sheet_of_edge[static_cast<std::size_t>(cell_edge(a, b))]);
        sum[sheet] += at;
        ++count[sheet];
      }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(sheets.count); ++i) {
      const Vec3 mean = sum[i] / count[i];
      vertices_.push_back(
          {place(cell.at.x + mean.x, cell.at.y + mean.y, cell.at.z + mean.z), block_id});
    }
  }

  const CrossedCell& crossed_cell(const Cell& at) const {
    const auto found =
        std::lower_bound(cells_.begin(), cells_.end(), at,
                         [](const CrossedCell& c, const Cell& key) { return c.at < key; });
    if (found == cells_.end() || found->at != at) {
      throw Error(ErrorKind::Internal, "polygonise: the bounds of the field are too narrow");
    }
    return *found;
  }

  /// A polygon around each crossed edge that starts at the first corner of the cell.
  void add_polygons(const CrossedCell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      if (bit(cell.mask, 0) == bit(cell.mask, 1 << axis)) continue;
      Polygon polygon = polygon_around(cell, axis);
      if (bit(cell.mask, 0) == 0) std::reverse(polygon.begin(), polygon.end());
      polygons_.push_back(std::move(polygon));
    }
  }

  /// Counter-clockwise seen from the far end of the edge. Two cells that share two pieces of the
  /// surface across one face would share two mesh edges with the same ends: each such edge gets a
  /// vertex of its own in its middle.
  Polygon polygon_around(const CrossedCell& cell, int axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const std::array<const CrossedCell*, 4> ring{&cell, &crossed_cell(moved(cell.at, u, -1)),
                                                 &crossed_cell(moved(moved(cell.at, u, -1), v, -1)),
                                                 &crossed_cell(moved(cell.at, v, -1))};
    const std::array<int, 4> base{0, 1 << u, 1 << u | 1 << v, 1 << v};  // the edge's start in each
    const std::array<int, 4> next_face{2 * u, 2 * v, 2 * u + 1, 2 * v + 1};
    const bool is_start_inside = bit(cell.mask, 0) == 1;
    Polygon polygon;
    for (std::size_t i = 0; i < 4; ++i) {
      const CellSheets& sheets = cell_sheets()[static_cast<std::size_t>(ring[i]->mask)];
      const CellSheets& next = cell_sheets()[static_cast<std::size_t>(ring[(i + 1) % 4]->mask)];
      const auto edge = static_cast<std::size_t>(cell_edge(base[i], base[i] | 1 << axis));
      polygon.push_back(ring[i]->first + static_cast<std::uint32_t>(sheets.sheet_of_edge[edge]));
      const int face = next_face[i];
      if (bit(sheets.doubled_faces, face) == 0 || bit(next.doubled_faces, face ^ 1) == 0) continue;
      const Cell inside = is_start_inside ? cell.at : moved(cell.at, axis, 1);
      polygon.push_back(middle_vertex(ring[i]->at, face, inside, polygon.back()));
    }
    return polygon;
  }

  /// The vertex on the piece of the surface that cuts the grid corner `inside` off a face.
  std::uint32_t middle_vertex(const Cell& cell, int face, const Cell& inside,
                              std::uint32_t neighbour) {
    const int axis = face / 2;
    const Cell face_at = moved(cell, axis, face & 1);
    const auto [found, is_new] = middle_vertices_.try_emplace(
        {face_at, axis, inside}, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) {
      const auto half = [axis](int a) { return a == axis ? 0.0 : 0.5; };
      const Vec3 centre = place(face_at.x + half(0), face_at.y + half(1), face_at.z + half(2));
      const Vec3 corner = place(inside.x, inside.y, inside.z);
      vertices_.push_back({(centre + corner) / 2, vertices_[neighbour].block});
    }
    return found->second;
  }

  /// Newton's step onto the surface, three times, never further than half a cell.
  void project(Vertex& v) const {
    const Field& field = *blocks_[v.block].field;
    for (int i = 0; i < 3; ++i) {
      const auto [value, slope] = field.sample(v.position);
      const double steepness = squared_length(slope);
      if (steepness < 1e-6) return;
      Vec3 step = slope * (-value / steepness);
      const double size = length(step);
      if (size > cell_ / 2) step = step * (cell_ / 2 / size);
      v.position += step;
      if (size < 1e-7 * cell_) return;
    }
  }

  /// Moves every vertex halfway to the middle of its neighbours and back onto the surface.
  void spread_vertices() {
    std::vector<Vec3> sum(vertices_.size());
    std::vector<int> count(vertices_.size());
    for (const Polygon& polygon : polygons_) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t a = polygon[i];
        const std::uint32_t b = polygon[(i + 1) % polygon.size()];
        sum[a] += vertices_[b].position;
        sum[b] += vertices_[a].position;
        ++count[a];
        ++count[b];
      }
    }
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      Vertex& v = vertices_[i];
      v.position = (v.position + sum[i] / count[i]) / 2;
      project(v);
    }
  }

  Shape triangulated() const {
    Shape shape;
    for (const Vertex& v : vertices_) shape.points.push_back(v.position);
    for (const Polygon& polygon : polygons_) {
      if (polygon.size() == 4) {
        append_quad(shape, polygon);
      } else {
        append_fan(shape, polygon);
      }
    }
    return shape;
  }

  /// Cut along the shorter diagonal. A diagonal joins two cells that share an edge only, so that no
  /// other polygon has it.
  static void append_quad(Shape& shape, const Polygon& q) {
    const auto& p = shape.points;
    if (distance(p[q[0]], p[q[2]]) <= distance(p[q[1]], p[q[3]])) {
      shape.triangles.push_back({q[0], q[1], q[2]});
      shape.triangles.push_back({q[0], q[2], q[3]});
    } else {
      shape.triangles.push_back({q[0], q[1], q[3]});
      shape.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  static void append_fan(Shape& shape, const Polygon& polygon) {
    Vec3 sum;
    for (const std::uint32_t v : polygon) sum += shape.points[v];
    const auto centre = static_cast<std::uint32_t>(shape.points.size());
    shape.points.push_back(sum / static_cast<double>(polygon.size()));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      shape.triangles.push_back({polygon[i], polygon[(i + 1) % polygon.size()], centre});
    }
  }

  double cell_;
  Vec3 origin_;
  std::vector<Block> blocks_;
  std::vector<CrossedCell> cells_;  ///< sorted by place
  std::vector<Vertex> vertices_;
  std::vector<Polygon> polygons_;
  std::map<std::tuple<Cell, int, Cell>, std::uint32_t> middle_vertices_;
};

}  // namespace

Shape polygonise(const Field& field, const Box& box, double cell) {
  return Polygoniser(field, box, cell).finish();
}

}  // namespace marrow
