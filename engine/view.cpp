#include <marrow/view.hpp>

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

}  // namespace

std::span<const Vec3> hemisphere_directions() { return kDirections; }

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
