#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "nrrd_header_detail.hpp"
#include "text_detail.hpp"

namespace marrow::volume_detail {

namespace {

constexpr std::size_t kMostAxes = 16;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string_view trimmed(std::string_view text) {
  text_detail::skip_blanks(text);
  while (!text.empty() && text_detail::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

struct Field {
  std::string_view value;
  std::uint64_t line = 0;
};

/// The fields of a header by their names, blanks in which do not count.
class Fields {
 public:
  explicit Fields(const Source& source) : source_(source) {
    text_detail::Lines lines(source.bytes);
    if (!lines.next() || !lines.line().starts_with("NRRD000"))
      volume_detail::fail(ErrorKind::Malformed, source,
                          "does not begin with 'NRRD000'; is it an NRRD file?");
    while (lines.next() && !lines.line().empty()) add(lines.line(), lines.number());
    end_ = source.bytes.size() - lines.rest().size();
  }

  const Field* find(const std::string& name) const {
    const auto at = fields_.find(name);
    return at == fields_.end() ? nullptr : &at->second;
  }
  const Field& need(const std::string& name) const {
    if (const Field* field = find(name)) return *field;
    volume_detail::fail(ErrorKind::Malformed, source_,
                        "the header has no field '" + name + "'; add it");
  }
  [[noreturn]] void fail(ErrorKind kind, const Field& field, const std::string& what) const {
    text_detail::fail(kind, source_.path, std::to_string(field.line), what);
  }
  std::size_t end() const { return end_; }

 private:
  void add(std::string_view line, std::uint64_t number) {
    if (line.starts_with('#')) return;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
      fail(ErrorKind::Malformed, {{}, number},
           "is no 'field: value'; mend it, or end the header with an empty line");
    if (line.substr(colon).starts_with(":=")) return;  // a key of somebody's own
    std::string name = lower(line.substr(0, colon));
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    const auto [at, is_new] =
        fields_.try_emplace(name, Field{trimmed(line.substr(colon + 1)), number});
    if (!is_new)
      fail(ErrorKind::Malformed, {{}, number},
           text_detail::quoted(name) + " is there twice; leave one of them");
  }

  const Source& source_;
  std::map<std::string, Field> fields_;
  std::size_t end_ = 0;
};

struct TypeName {
  const char* name;
  VoxelType type;
};

constexpr TypeName kTypes[] = {{"signed char", VoxelType::I8},
                               {"int8", VoxelType::I8},
                               {"int8_t", VoxelType::I8},
                               {"uchar", VoxelType::U8},
                               {"unsigned char", VoxelType::U8},
                               {"uint8", VoxelType::U8},
                               {"uint8_t", VoxelType::U8},
                               {"short", VoxelType::I16},
                               {"short int", VoxelType::I16},
                               {"signed short", VoxelType::I16},
                               {"signed short int", VoxelType::I16},
                               {"int16", VoxelType::I16},
                               {"int16_t", VoxelType::I16},
                               {"ushort", VoxelType::U16},
                               {"unsigned short", VoxelType::U16},
                               {"unsigned short int", VoxelType::U16},
                               {"uint16", VoxelType::U16},
                               {"uint16_t", VoxelType::U16},
                               {"int", VoxelType::I32},
                               {"signed int", VoxelType::I32},
                               {"int32", VoxelType::I32},
                               {"int32_t", VoxelType::I32},
                               {"uint", VoxelType::U32},
                               {"unsigned int", VoxelType::U32},
                               {"uint32", VoxelType::U32},
                               {"uint32_t", VoxelType::U32},
                               {"longlong", VoxelType::I64},
                               {"long long", VoxelType::I64},
                               {"long long int", VoxelType::I64},
                               {"signed long long", VoxelType::I64},
                               {"signed long long int", VoxelType::I64},
                               {"int64", VoxelType::I64},
                               {"int64_t", VoxelType::I64},
                               {"ulonglong", VoxelType::U64},
                               {"unsigned long long", VoxelType::U64},
                               {"unsigned long long int", VoxelType::U64},
                               {"uint64", VoxelType::U64},
                               {"uint64_t", VoxelType::U64},
                               {"float", VoxelType::F32},
                               {"double", VoxelType::F64}};

VoxelType type_of(const Fields& fields) {
  const Field& field = fields.need("type");
  const std::string name = lower(field.value);
  for (const TypeName& t : kTypes)
    if (name == t.name) return t.type;
  fields.fail(ErrorKind::Unsupported, field,
              "values of type " + text_detail::quoted(field.value) +
                  " are not read; convert them to integers or floats");
}

NrrdEncoding encoding_of(const Fields& fields) {
  const Field& field = fields.need("encoding");
  const std::string name = lower(field.value);
  if (name == "raw") return NrrdEncoding::Raw;
  if (name == "gzip" || name == "gz") return NrrdEncoding::Gzip;
  if (name == "ascii" || name == "text" || name == "txt") return NrrdEncoding::Text;
  fields.fail(ErrorKind::Unsupported, field,
              "encoding " + text_detail::quoted(field.value) +
                  " is not read; save it as raw, gzip or ascii");
}

std::endian order_of(const Fields& fields, const Samples& samples, NrrdEncoding encoding) {
  if (encoding == NrrdEncoding::Text || bytes_of(samples.type) == 1) return std::endian::little;
  const Field& field = fields.need("endian");
  const std::string name = lower(field.value);
  if (name == "little") return std::endian::little;
  if (name == "big") return std::endian::big;
  fields.fail(ErrorKind::Malformed, field,
              "endian is " + text_detail::quoted(field.value) + ", not little or big; mend it");
}

/// As many numbers as there are axes.
template <class Number, class Take>
std::vector<Number> per_axis(const Fields& fields, const Field& field, std::size_t axes,
                             const Take& take) {
  std::string_view text = field.value;
  std::vector<Number> values(axes);
  for (Number& value : values)
    if (!take(text, value))
      fields.fail(ErrorKind::Malformed, field,
                  "needs " + std::to_string(axes) + " numbers, one per axis; mend the line");
  return values;
}

/// "(1,0,0.5)" taken off `text`; none for the word none.
bool take_vector(std::string_view& text, std::optional<Vec3>& vector) {
  text_detail::skip_blanks(text);
  if (lower(text.substr(0, 4)) == "none") {
    text.remove_prefix(4);
    vector.reset();
    return true;
  }
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) return false;
  std::string inside(text.substr(1, end - 1));
  text.remove_prefix(end + 1);
  if (std::count(inside.begin(), inside.end(), ',') != 2) return false;
  std::replace(inside.begin(), inside.end(), ',', ' ');
  std::string_view rest = inside;
  Vec3 v;
  const bool is_right = text_detail::take_number(rest, v.x) &&
                        text_detail::take_number(rest, v.y) && text_detail::take_number(rest, v.z);
  vector = v;
  return is_right && trimmed(rest).empty();
}

/// The three axes with voxels: of others, which must have one place only, the last ones go first.
std::vector<std::size_t> volume_axes(const Fields& fields,
                                     const std::vector<std::uint64_t>& sizes) {
  std::vector<std::size_t> axes;
  for (std::size_t i = 0; i < sizes.size(); ++i) axes.push_back(i);
  for (std::size_t i = sizes.size(); i-- > 0 && axes.size() > 3;)
    if (sizes[i] == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(i));
  if (axes.size() != 3)
    fields.fail(ErrorKind::Unsupported, fields.need("sizes"),
                "has " + std::to_string(axes.size()) +
                    " axes, a volume has three; save one volume of single numbers alone");
  return axes;
}

std::size_t axis_count(const Fields& fields) {
  const Field& field = fields.need("dimension");
  std::string_view text = field.value;
  std::size_t axes = 0;
  if (!text_detail::take_integer(text, axes) || axes < 1 || axes > kMostAxes)
    fields.fail(ErrorKind::Malformed, field,
                "dimension is " + text_detail::quoted(field.value) + ", not 1 to 16; mend it");
  return axes;
}

constexpr const char* kNotThree = "has no three numbers like (1,0,0); mend it, or give a 3D space";

void read_directions(const Fields& fields, const Field& field, std::size_t count,
                     const std::vector<std::size_t>& axes, Placement& placement) {
  std::string_view text = field.value;
  std::vector<std::optional<Vec3>> directions(count);
  for (auto& direction : directions)
    if (!take_vector(text, direction)) fields.fail(ErrorKind::Malformed, field, kNotThree);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!directions[axes[i]])
      fields.fail(ErrorKind::Malformed, field, "an axis of the volume has no direction; mend it");
    placement.steps[i] = *directions[axes[i]];
  }
}

void read_spacings(const Fields& fields, const Field& field, std::size_t count,
                   const std::vector<std::size_t>& axes, Placement& placement) {
  const auto spacings = per_axis<double>(fields, field, count, text_detail::take_number);
  for (std::size_t i = 0; i < 3; ++i) {
    const double spacing = spacings[axes[i]];
    // Not a number says that it is not known.
    placement.steps[i] = placement.steps[i] * (std::isnan(spacing) ? 1.0 : spacing);
  }
}

Placement placement_of(const Fields& fields) {
  const std::size_t count = axis_count(fields);
  const auto sizes = per_axis<std::uint64_t>(fields, fields.need("sizes"), count,
                                             [](std::string_view& text, std::uint64_t& value) {
                                               return text_detail::take_integer(text, value);
                                             });
  const auto axes = volume_axes(fields, sizes);
  Placement placement;
  for (std::size_t i = 0; i < 3; ++i) placement.dims[i] = sizes[axes[i]];
  if (const Field* field = fields.find("spacedirections"))
    read_directions(fields, *field, count, axes, placement);
  else if (const Field* spacings = fields.find("spacings"))
    read_spacings(fields, *spacings, count, axes, placement);
  if (const Field* field = fields.find("spaceorigin")) {
    std::string_view text = field->value;
    std::optional<Vec3> origin;
    if (!take_vector(text, origin) || !origin) fields.fail(ErrorKind::Malformed, *field, kNotThree);
    placement.origin = *origin;
  }
  return placement;
}

/// A file that the header names must lie beside it: a plain name, so that no header reaches
/// anything else.
std::string data_file_of(const Fields& fields) {
  const Field* field = fields.find("datafile");
  if (!field) return {};
  std::string_view name = field->value;
  if (name.starts_with("./")) name.remove_prefix(2);
  const bool is_list = name.starts_with("LIST") || name.find('%') != std::string_view::npos;
  if (is_list)
    fields.fail(ErrorKind::Unsupported, *field,
                "the values are in several files; save them as one");
  const bool is_plain = !name.empty() && name != "." && name != ".." &&
                        name.find_first_of("/\\") == std::string_view::npos &&
                        !text_detail::has_control_characters(name);
  if (!is_plain)
    fields.fail(ErrorKind::Unsupported, *field,
                "data file " + text_detail::quoted(name) +
                    " is not beside the header; move it there and give its name alone");
  return std::string(name);
}

std::int64_t skip_of(const Fields& fields, const char* name, std::int64_t least) {
  const Field* field = fields.find(name);
  if (!field) return 0;
  std::string_view text = field->value;
  std::int64_t skip = 0;
  if (!text_detail::take_integer(text, skip) || skip < least)
    fields.fail(ErrorKind::Malformed, *field,
                "skips " + text_detail::quoted(field->value) + "; give a whole number from " +
                    std::to_string(least));
  return skip;
}

}  // namespace

NrrdHeader parse_nrrd_header(const Source& source) {
  const Fields fields(source);
  NrrdHeader header;
  header.end = fields.end();
  header.samples.type = type_of(fields);
  header.encoding = encoding_of(fields);
  header.samples.order = order_of(fields, header.samples, header.encoding);
  header.placement = placement_of(fields);
  header.data_file = data_file_of(fields);
  header.line_skip = static_cast<std::uint64_t>(skip_of(fields, "lineskip", 0));
  const std::int64_t bytes = skip_of(fields, "byteskip", -1);
  header.is_at_end = bytes < 0;
  header.byte_skip = static_cast<std::uint64_t>(std::max<std::int64_t>(bytes, 0));
  if (header.is_at_end && header.encoding != NrrdEncoding::Raw)
    volume_detail::fail(ErrorKind::Malformed, source,
                        "byte skip -1 is for raw encoding only; give the number of bytes");
  return header;
}

}  // namespace marrow::volume_detail
