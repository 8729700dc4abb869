#include <marrow/error.hpp>
#include <marrow/view.hpp>

#include <algorithm>
#include <string>

namespace marrow {

namespace {

// Vertices of the icosahedron: (0, 1, phi) normalised and its cyclic permutations; then the
// midpoints of its edges, normalised: the axes, and ((phi-1)/2, phi/2, 1/2), its cyclic
// permutations and signs.
constexpr double a = 0.52573111211913360603;  // 1 / sqrt(1 + phi^2)
constexpr double b = 0.85065080835203993218;  // phi / sqrt(1 + phi^2)
constexpr double c = 0.5;
constexpr double d = 0.80901699437494742410;  // phi / 2
constexpr double e = 0.30901699437494742410;  // (phi - 1) / 2

constexpr std::array<Vec3, 21> kDirections{{
    {0, a, b},  {0, -a, b}, {a, b, 0},  {-a, b, 0}, {b, 0, a},  {b, 0, -a}, {1, 0, 0},
    {0, 1, 0},  {0, 0, 1},  {e, d, c},  {-e, d, c}, {e, -d, c}, {e, d, -c}, {c, e, d},
    {-c, e, d}, {c, -e, d}, {c, e, -d}, {d, c, e},  {-d, c, e}, {d, -c, e}, {d, c, -e},
}};

// Vertices of the once subdivided icosahedron are joined by an edge where their dot product is
// 0.809 or 0.851; the next ones have 0.588.
constexpr double kEdge = 0.7;

constexpr double kSameDirection = 1e-6;

/// One of each antipodal pair.
bool is_upper(const Vec3& p) {
  if (p.z != 0) return p.z > 0;
  return p.y != 0 ? p.y > 0 : p.x > 0;
}

/// Scaled first, so that no square overflows or vanishes.
Vec3 unit_of(const Vec3& direction, std::size_t number) {
  const double most =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(most > 0) || !std::isfinite(direction.x + direction.y + direction.z))
    throw Error(ErrorKind::Usage, "direction " + std::to_string(number) +
                                      " is no direction: give finite numbers, not all 0");
  return normalized(direction / most);
}

/// The vertices of the once subdivided icosahedron and the middles of its edges, one of each pair.
std::vector<Vec3> subdivided() {
  std::vector<Vec3> vertices(kDirections.begin(), kDirections.end()), directions = vertices;
  for (const Vec3& v : kDirections) vertices.push_back(-v);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 middle = vertices[i] + vertices[j];
      if (dot(vertices[i], vertices[j]) > kEdge && is_upper(middle))
        directions.push_back(normalized(middle));
    }
  return directions;
}

}  // namespace

std::span<const Vec3> hemisphere_directions() { return kDirections; }

std::span<const Vec3> fine_hemisphere_directions() {
  static const std::vector<Vec3> directions = subdivided();
  return directions;
}

std::vector<Vec3> distinct_directions(std::span<const Vec3> directions) {
  std::vector<Vec3> distinct;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 unit = unit_of(directions[i], i + 1);
    const auto is_same = [&](const Vec3& other) {
      return length(cross(other, unit)) <= kSameDirection;
    };
    if (std::none_of(distinct.begin(), distinct.end(), is_same)) distinct.push_back(unit);
  }
  return distinct;
}

Frame frame_along(const Vec3& direction) {
  const Vec3 z = normalized(direction);
  // The input axis farthest from the direction; a later one must be clearly farther.
  Vec3 far{1, 0, 0};
  double least = std::abs(z.x);
  if (std::abs(z.y) < least - 1e-9) far = {0, 1, 0}, least = std::abs(z.y);
  if (std::abs(z.z) < least - 1e-9) far = {0, 0, 1};
  const Vec3 x = normalized(far - z * dot(far, z));
  return {x, cross(z, x), z};
}

}  // namespace marrow
