#include <marrow/error.hpp>

#include <algorithm>

#include "text_detail.hpp"
#include "volume_detail.hpp"

namespace marrow::volume_detail {

namespace {

constexpr std::uint64_t kMostPerByte = 128;  // a run of 255 takes two bytes

struct Header {
  std::array<std::uint64_t, 3> dims{};  // depth (x), height (z), width (y)
  Vec3 translation;
  double scale = 1;
};

[[noreturn]] void fail_at(const Source& source, const text_detail::Lines& lines,
                          const std::string& what) {
  text_detail::fail(ErrorKind::Malformed, source.path, std::to_string(lines.number()), what);
}

Header read_header(text_detail::Lines& lines, const Source& source) {
  if (!lines.next() || !lines.line().starts_with("#binvox"))
    fail(ErrorKind::Malformed, source, "does not begin with '#binvox'; is it a binvox file?");
  Header h;
  while (lines.next()) {
    std::string_view line = lines.line();
    const std::string_view word = text_detail::take_word(line);
    if (word == "data") return h;
    bool is_right = true;
    if (word == "dim") {
      for (auto& n : h.dims) is_right = is_right && text_detail::take_integer(line, n);
    } else if (word == "translate") {
      for (double* c : {&h.translation.x, &h.translation.y, &h.translation.z})
        is_right = is_right && text_detail::take_number(line, *c);
    } else if (word == "scale") {
      is_right = text_detail::take_number(line, h.scale);
    }
    if (!is_right)
      fail_at(source, lines,
              "numbers are missing behind '" + std::string(word) + "'; mend the line");
  }
  fail_at(source, lines, "the header has no line 'data'; get a whole file");
}

/// Voxel (i, j, k) of the file lies at x = k, y = i, z = j: y runs fastest, then z. Its cube has
/// the greatest size along all three edges.
Placement placement_of(const Header& h) {
  const auto [x, z, y] = h.dims;
  const double edge = h.scale / static_cast<double>(std::max({x, y, z, std::uint64_t{1}}));
  return {{y, z, x},
          h.translation + Vec3{0.5, 0.5, 0.5} * edge,
          {Vec3{0, edge, 0}, Vec3{0, 0, edge}, Vec3{edge, 0, 0}}};
}

}  // namespace

Volume parse_binvox(const Source& source) {
  text_detail::Lines lines(source.bytes);
  const Header header = read_header(lines, source);
  const std::string_view runs = lines.rest();
  Volume volume = make_volume(placement_of(header), runs.size() * kMostPerByte, source);
  FlagWriter writer(volume);
  for (std::size_t i = 0; i + 1 < runs.size() && writer.left() > 0; i += 2) {
    const auto count = static_cast<unsigned char>(runs[i + 1]);
    if (count > writer.left())
      fail(ErrorKind::Malformed, source, "its runs are longer than it has voxels; mend 'dim'");
    writer.put_run(runs[i] != 0, count);
  }
  if (writer.left() > 0)
    fail(ErrorKind::Malformed, source,
         "the runs end early, " + std::to_string(writer.left()) +
             " voxels are missing; get a whole file");
  return volume;
}

}  // namespace marrow::volume_detail
