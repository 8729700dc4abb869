#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include "byte_stream_detail.hpp"
#include "text_detail.hpp"

namespace marrow::bytes_detail {

namespace {

constexpr std::uint64_t kMostPerByte = 1032;  // deflate packs no tighter
constexpr std::size_t kLargestFeed = std::size_t{1} << 30;
constexpr int kGzipOrZlib = 15 + 32;  // window bits: any window, and see what kind it is

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

void ByteStream::EndInflate::operator()(z_stream* stream) const {
  inflateEnd(stream);
  delete stream;
}

ByteStream::ByteStream(std::string_view bytes, bool compressed, std::string name)
    : rest_(bytes), name_(std::move(name)) {
  if (!compressed) return;
  inflate_.reset(new z_stream{});
  if (inflateInit2(inflate_.get(), kGzipOrZlib) != Z_OK) throw std::bad_alloc();
}

std::size_t ByteStream::read(std::span<char> into) {
  if (inflate_) return inflate_into(into);
  const std::size_t count = std::min(into.size(), rest_.size());
  std::memcpy(into.data(), rest_.data(), count);
  rest_.remove_prefix(count);
  return count;
}

bool ByteStream::skip(std::uint64_t count) {
  if (!inflate_) {
    if (count > rest_.size()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(count));
    return true;
  }
  std::array<char, 1 << 14> passed{};
  while (count > 0) {
    const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(count, passed.size()));
    const std::size_t got = read(std::span(passed).first(most));
    if (got == 0) return false;
    count -= got;
  }
  return true;
}

std::uint64_t ByteStream::most_left() const {
  if (!inflate_) return rest_.size();
  // What has been taken in and not yet given out fits the first summand.
  return (std::uint64_t{1} << 16) + (rest_.size() + inflate_->avail_in) * kMostPerByte;
}

void ByteStream::feed() {
  if (inflate_->avail_in > 0) return;
  const std::size_t count = std::min(rest_.size(), kLargestFeed);
  // zlib reads through this pointer only.
  inflate_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
  inflate_->avail_in = static_cast<uInt>(count);
  rest_.remove_prefix(count);
}

std::size_t ByteStream::inflate_into(std::span<char> into) {
  z_stream& z = *inflate_;
  z.next_out = reinterpret_cast<Bytef*>(into.data());
  z.avail_out = static_cast<uInt>(into.size());
  while (z.avail_out > 0 && !is_at_end_) {
    feed();
    const int result = inflate(&z, Z_NO_FLUSH);
    if (result == Z_STREAM_END) {
      // gzip files may follow each other; other bytes behind the end are no matter of ours.
      feed();
      is_at_end_ = z.avail_in == 0 || *z.next_in != 0x1f || inflateReset(&z) != Z_OK;
    } else if (result == Z_BUF_ERROR && z.avail_in == 0 && rest_.empty()) {
      text_detail::fail(ErrorKind::Malformed, name_, "",
                        "the compressed data end early; the file is cut off, get a whole one");
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      text_detail::fail(ErrorKind::Malformed, name_, "",
                        "the compressed data are broken; get a whole file");
    }
  }
  return into.size() - z.avail_out;
}

}  // namespace marrow::bytes_detail
