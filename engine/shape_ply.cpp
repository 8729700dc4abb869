// PLY, text and binary of either byte order. What is not known is skipped by its type.

#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <limits>
#include <utility>

#include "bytes_detail.hpp"
#include "ply_detail.hpp"
#include "ply_rows_detail.hpp"
#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using namespace ply_detail;
using text_detail::quoted;

/// Where a property stands among those of its element, or none.
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::size_t find_property(const Element& element, bool is_list,
                          std::initializer_list<std::string_view> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    for (const std::string_view name : names)
      if (element.properties[i].name == name && element.properties[i].is_list == is_list) return i;
  return kNone;
}

/// The bytes of the properties before `end` in a binary row; they are no lists.
std::size_t bytes_before(const Element& element, std::size_t end) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < end; ++i) sum += size_of(element.properties[i].type);
  return sum;
}

template <class Rows>
class BodyReader {
 public:
  BodyReader(const Source& source, const Header& header)
      : name_(source.name),
        header_(header),
        rows_(source.name, header),
        builder_(source, Rows::kBinary ? "vertex " : "") {}

  Shape read() && {
    for (const Element& e : header_.elements)
      if (e.name == "vertex") point_count_ = e.count;
    std::size_t last_row_bytes = 0;
    for (const Element& e : header_.elements) {
      if (e.count == 0) continue;
      check_count(e);
      read_element(e);
      last_row_bytes = e.row_bytes(header_.encoding);
    }
    rows_.end_body(last_row_bytes);
    return std::move(builder_).finish();
  }

 private:
  /// A count is only believed if the rest of the file has room for it.
  void check_count(const Element& e) const {
    const std::size_t row_bytes = e.row_bytes(header_.encoding);
    if (row_bytes != 0 && e.count > rows_.bytes_left() / row_bytes)
      text_detail::fail(ErrorKind::Malformed, name_, "header",
                        "counts " + std::to_string(e.count) + " rows of element " + quoted(e.name) +
                            ", but only " + std::to_string(rows_.bytes_left()) +
                            " bytes are left; the file was cut short or its header is wrong");
  }

  void read_element(const Element& e) {
    const std::size_t indices = find_property(e, true, {"vertex_indices", "vertex_index"});
    if (e.name == "vertex")
      read_vertices(e);
    else if (e.name == "face")
      read_faces(e, indices);
    else if (e.name == "tristrips" && indices != kNone)
      read_strips(e, indices);
    else
      skip_rows(e);
  }

  void skip_rows(const Element& e) {
    if (e.properties.empty()) return;
    if (Rows::kBinary && !e.has_lists()) {
      rows_.begin_row(e, 0);
      return rows_.skip(Type::Uint8, e.count * e.row_bytes(header_.encoding));
    }
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      for (const Property& p : e.properties) skip(p);
      rows_.end_row();
    }
  }

  void skip(const Property& p) { rows_.skip(p.type, p.is_list ? take_list_size(p) : 1); }

  std::uint64_t take_list_size(const Property& p) {
    const std::int64_t size = rows_.integer(p.count_type);
    if (size < 0 || static_cast<std::uint64_t>(size) > rows_.most_values(p.type))
      rows_.fail("a list of " + std::to_string(size) + " values, for which there is no room");
    return static_cast<std::uint64_t>(size);
  }

  void read_vertices(const Element& e) {
    const std::array<std::size_t, 3> xyz{find_property(e, false, {"x"}),
                                         find_property(e, false, {"y"}),
                                         find_property(e, false, {"z"})};
    for (const std::size_t i : xyz)
      if (i == kNone)
        text_detail::fail(ErrorKind::Malformed, name_, "header", "vertices without x, y and z");
    if (e.count > std::numeric_limits<std::uint32_t>::max())
      text_detail::fail(ErrorKind::Limit, name_, "header", "counts more than 4294967295 vertices");
    builder_.reserve(e.count, 0);
    if constexpr (Rows::kBinary) {
      const auto all_of = [&](Type type) {
        return !e.has_lists() && e.properties[xyz[0]].type == type &&
               e.properties[xyz[1]].type == type && e.properties[xyz[2]].type == type;
      };
      if (all_of(Type::Float32)) return read_plain_vertices<float>(e, xyz);
      if (all_of(Type::Float64)) return read_plain_vertices<double>(e, xyz);
    }
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      std::array<double, 3> p{};
      for (std::size_t i = 0; i < e.properties.size(); ++i) {
        const auto axis =
            static_cast<std::size_t>(std::find(xyz.begin(), xyz.end(), i) - xyz.begin());
        if (axis == 3)
          skip(e.properties[i]);
        else
          p[axis] = rows_.number(e.properties[i].type);
      }
      rows_.end_row();
      builder_.add_point({p[0], p[1], p[2]}, rows_.number());
    }
  }

  /// Rows of one size, of which there are enough: nothing is left to be checked.
  template <class Number>
  void read_plain_vertices(const Element& e, const std::array<std::size_t, 3>& xyz) {
    using bytes_detail::load;
    const std::size_t x = bytes_before(e, xyz[0]), y = bytes_before(e, xyz[1]),
                      z = bytes_before(e, xyz[2]), size = e.row_bytes(header_.encoding);
    rows_.begin_row(e, 0);
    const char* at = rows_.at();
    for (std::uint64_t row = 0; row < e.count; ++row, at += size)
      builder_.add_point({static_cast<double>(load<Number, Rows::kOrder>(at + x)),
                          static_cast<double>(load<Number, Rows::kOrder>(at + y)),
                          static_cast<double>(load<Number, Rows::kOrder>(at + z))},
                         row);
    rows_.advance(e.count * size);
  }

  void read_faces(const Element& e, std::size_t list) {
    if (list == kNone)
      text_detail::fail(ErrorKind::Malformed, name_, "header",
                        "faces without a list 'vertex_indices' or 'vertex_index'");
    if (e.properties[list].type == Type::Float32 || e.properties[list].type == Type::Float64)
      text_detail::fail(ErrorKind::Malformed, name_, "header",
                        "indices that are not of an integer type");
    builder_.reserve(0, std::min(e.count, rows_.bytes_left() / 6));
    const bool plain = has_plain_triangles(e, list);
    for (std::uint64_t row = 0; row < e.count; ++row) {
      if (plain) row += read_plain_triangles(e, list, row);
      if (row == e.count) break;
      rows_.begin_row(e, row);
      for (std::size_t i = 0; i < e.properties.size(); ++i) {
        if (i == list)
          take_corners(e.properties[i]);
        else
          skip(e.properties[i]);
      }
      rows_.end_row();
      builder_.add_face(corners_);
    }
  }

  void take_corners(const Property& p) {
    corners_.clear();
    const std::uint64_t size = take_list_size(p);
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::int64_t index = rows_.integer(p.type);
      if (index < 0 || static_cast<std::uint64_t>(index) >= point_count_)
        rows_.fail("vertex index " + std::to_string(index) + " is out of range, there are " +
                   std::to_string(point_count_) + " vertices from 0 on; repair or remove the face");
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
  }

  /// Triangles take rows of one size if their list is the only one, in the usual types.
  bool has_plain_triangles(const Element& e, std::size_t list) const {
    const auto lists = std::count_if(e.properties.begin(), e.properties.end(),
                                     [](const Property& p) { return p.is_list; });
    const Property& p = e.properties[list];
    return Rows::kBinary && lists == 1 && size_of(p.count_type) == 1 && size_of(p.type) == 4;
  }

  /// As many triangles from `row` on as can be read without looking closer; returns their number.
  std::uint64_t read_plain_triangles(const Element& e, std::size_t list, std::uint64_t row) {
    if constexpr (Rows::kBinary) {
      using bytes_detail::load;
      constexpr std::size_t kIndexBytes = 12;
      const std::size_t size = e.row_bytes(header_.encoding) + kIndexBytes;
      const std::uint64_t room = std::min(e.count - row, rows_.bytes_left() / size);
      const char* at = rows_.at() + bytes_before(e, list);
      std::uint64_t done = 0;
      for (; done < room && *at == 3; ++done, at += size) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k)
          t[k] = load<std::uint32_t, Rows::kOrder>(at + 1 + 4 * k);
        // Negative ones are huge here. Whoever looks closer says what is wrong.
        if (std::max({t[0], t[1], t[2]}) >= point_count_) break;
        builder_.add_triangle(t);
      }
      rows_.advance(done * size);
      return done;
    }
    return 0;
  }

  void read_strips(const Element& e, std::size_t list) {
    for (std::uint64_t row = 0; row < e.count; ++row) {
      rows_.begin_row(e, row);
      for (std::size_t i = 0; i < e.properties.size(); ++i) {
        if (i == list)
          read_strip(e.properties[i]);
        else
          skip(e.properties[i]);
      }
      rows_.end_row();
    }
  }

  /// Every three indices in a row are a triangle; -1 begins anew.
  void read_strip(const Property& p) {
    const std::uint64_t size = take_list_size(p);
    corners_.clear();
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::int64_t index = rows_.integer(p.type);
      if (index == -1) {
        corners_.clear();
        continue;
      }
      if (index < 0 || static_cast<std::uint64_t>(index) >= point_count_)
        rows_.fail("vertex index " + std::to_string(index) + " is out of range, there are " +
                   std::to_string(point_count_) + " vertices from 0 on");
      corners_.push_back(static_cast<std::uint32_t>(index));
      const std::size_t n = corners_.size();
      if (n < 3) continue;
      // Every other triangle of a strip is turned the other way.
      Triangle t{corners_[n - 3], corners_[n - 2], corners_[n - 1]};
      if (n % 2 == 0) std::swap(t[0], t[1]);
      builder_.add_triangle(t);
    }
  }

  std::string name_;
  const Header& header_;
  Rows rows_;
  ShapeBuilder builder_;
  std::uint64_t point_count_ = 0;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Shape parse_ply(const Source& source) {
  const Header header = parse_header(source.bytes, source.name);
  switch (header.encoding) {
    case Encoding::Text:
      text_detail::check_is_text(source.bytes, source.name);
      return BodyReader<TextRows>(source, header).read();
    case Encoding::BinaryLittle:
      return BodyReader<BinaryRows<std::endian::little>>(source, header).read();
    case Encoding::BinaryBig:
      return BodyReader<BinaryRows<std::endian::big>>(source, header).read();
  }
  return {};
}

std::string format_ply(const Shape& shape) {
  // Most readers take indices as signed.
  if (shape.points.size() > std::size_t{1} << 31)
    throw Error(ErrorKind::Limit, "a PLY of signed indices holds at most 2147483648 vertices");
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  text_detail::append(bytes, shape.points.size());
  bytes += "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
  text_detail::append(bytes, shape.triangles.size());
  bytes += "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + 24 * shape.points.size() + 13 * shape.triangles.size());
  for (const Vec3& p : shape.points)
    for (const double x : {p.x, p.y, p.z}) bytes_detail::append_little(bytes, x);
  for (const Triangle& t : shape.triangles) {
    bytes += '\3';
    for (const std::uint32_t i : t) bytes_detail::append_little(bytes, i);
  }
  return bytes;
}

}  // namespace marrow::shape_detail
