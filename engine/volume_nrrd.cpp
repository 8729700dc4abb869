#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <zlib.h>

#include <algorithm>

#include "nrrd_header_detail.hpp"
#include "text_detail.hpp"

namespace marrow::volume_detail {

namespace {

std::string beside(const std::string& path, const std::string& name) {
  const std::size_t slash = path.rfind('/');
  // Never a bare name: "-" would be standard input.
  return (slash == std::string::npos ? "./" : path.substr(0, slash + 1)) + name;
}

std::string_view without_lines(std::string_view bytes, std::uint64_t count, const Source& source) {
  for (; count > 0; --count) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos)
      fail(ErrorKind::Malformed, source, "has fewer lines than 'line skip' says; mend it");
    bytes.remove_prefix(end + 1);
  }
  return bytes;
}

/// The values of the text encoding: numbers between blanks and ends of line.
void read_text(Volume& volume, std::string_view text, const Source& source) {
  FlagWriter writer(volume);
  text_detail::Lines lines(text);
  while (writer.left() > 0 && lines.next()) {
    std::string_view line = lines.line();
    double value = 0;
    while (writer.left() > 0 && text_detail::take_number(line, value))
      writer.put(value > source.options.iso, 1);
    const std::string_view word = text_detail::take_word(line);
    if (writer.left() > 0 && !word.empty())
      fail(ErrorKind::Malformed, source,
           "has " + text_detail::quoted(word) + " among its values; mend it");
  }
  if (writer.left() > 0)
    fail(ErrorKind::Malformed, source,
         "holds " + std::to_string(writer.left()) + " values less than voxels; get a whole file");
}

/// How many values can be in these bytes, whatever they are.
std::uint64_t most_voxels(const NrrdHeader& header, std::uint64_t bytes) {
  if (header.encoding == NrrdEncoding::Text) return (bytes + 1) / 2;
  return bytes / bytes_of(header.samples.type);
}

Volume parse_values(std::string_view bytes, const NrrdHeader& header, const Source& source) {
  bytes = without_lines(bytes, header.line_skip, source);
  bytes_detail::ByteStream stream(bytes, header.encoding == NrrdEncoding::Gzip, source.path);
  if (!stream.skip(header.byte_skip))
    fail(ErrorKind::Malformed, source, "has fewer bytes than 'byte skip' says; mend it");
  const std::uint64_t left = stream.most_left();
  Volume volume = make_volume(header.placement, most_voxels(header, left), source);
  if (header.is_at_end) {
    const auto& [nx, ny, nz] = header.placement.dims;
    stream.skip(left - nx * ny * nz * bytes_of(header.samples.type));
  }
  if (header.encoding == NrrdEncoding::Text)
    read_text(volume, bytes.substr(static_cast<std::size_t>(header.byte_skip)), source);
  else
    read_samples(volume, stream, header.samples, source);
  return volume;
}

std::string gzip(std::string_view bytes) {
  constexpr int kGzip = 15 + 16, kDefaultMemory = 8;
  z_stream z{};
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kDefaultMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string result;
  char piece[1 << 16];
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (z.avail_in == 0) {
      const std::size_t count = std::min(bytes.size(), std::size_t{1} << 30);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      z.avail_in = static_cast<uInt>(count);
      bytes.remove_prefix(count);
    }
    z.next_out = reinterpret_cast<Bytef*>(piece);
    z.avail_out = sizeof piece;
    state = deflate(&z, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    result.append(piece, sizeof piece - z.avail_out);
  }
  deflateEnd(&z);
  return result;
}

void append_vector(std::string& text, const Vec3& v) {
  text += '(';
  text_detail::append(text, v.x);
  text += ',';
  text_detail::append(text, v.y);
  text += ',';
  text_detail::append(text, v.z);
  text += ')';
}

}  // namespace

Volume parse_nrrd(const Source& source) {
  const NrrdHeader header = parse_nrrd_header(source);
  if (header.data_file.empty())
    return parse_values(source.bytes.substr(header.end), header, source);
  const std::string path = beside(source.path, header.data_file);
  const std::string bytes = read_file(path, source.options.max_bytes);
  return parse_values(bytes, header, {bytes, path, source.options});
}

}  // namespace marrow::volume_detail

namespace marrow {

std::string format_nrrd(const Volume& volume) {
  std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes:";
  for (const int n : {volume.nx, volume.ny, volume.nz}) text += ' ' + std::to_string(n);
  text += "\nspace dimension: 3\nspace directions:";
  for (const Vec3& step : volume.steps) text += ' ', volume_detail::append_vector(text, step);
  text += "\nspace origin: ";
  volume_detail::append_vector(text, volume.origin);
  text += "\nkinds: domain domain domain\nencoding: gzip\n\n";
  std::string values;
  values.reserve(static_cast<std::size_t>(volume.nx) * static_cast<std::size_t>(volume.ny) *
                 static_cast<std::size_t>(volume.nz));
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) values += static_cast<char>(volume(x, y, z));
  return text + volume_detail::gzip(values);
}

}  // namespace marrow
