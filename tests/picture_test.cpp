#include <marrow/error.hpp>

#include <png.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "catch.hpp"
#include "picture/camera.hpp"
#include "picture/colour_map.hpp"
#include "picture/font.hpp"
#include "picture/legend.hpp"
#include "picture/png.hpp"
#include "picture/render.hpp"
#include "picture/stage_images.hpp"
#include "scale.hpp"

using namespace marrow;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A ball of radius 1 about the origin, cut by meridians and circles of latitude.
Shape ball(int rings, int segments) {
  Shape shape;
  for (int i = 0; i <= rings; ++i) {
    const double polar = kPi * i / rings;
    for (int j = 0; j < segments; ++j) {
      const double around = 2 * kPi * j / segments;
      shape.points.push_back({std::sin(polar) * std::cos(around),
                              std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * segments + j % segments);
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      shape.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      shape.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return shape;
}

Shape ball() { return ball(scaled(64, 24), scaled(128, 48)); }

CurveSkeleton rod() { return {{{{-0.5, 0, 0}, 0.5}, {{0.5, 0, 0}, 0.25}}, {{0, 1}}}; }

constexpr int kLegend = 20;  // height of the legend of small pictures

/// The part of a picture with the views.
Rect views_of(const RgbImage& image) { return {0, 0, image.width, image.height - kLegend}; }

/// The front view, two by two.
Rect front_of(const RgbImage& image) {
  return {0, 0, image.width / 2, (image.height - kLegend) / 2};
}

RenderOptions small() { return {scaled(800, 400), scaled(600, 300)}; }

/// Large enough for single pixels of the skeleton to be looked at.
RenderOptions legible() { return {800, 600}; }

template <class Call>
ErrorKind kind_of(Call&& call) {
  try {
    call();
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find('\n') == std::string::npos);
    return e.kind();
  }
  FAIL("no error");
  return ErrorKind::Internal;
}

struct Pixel {
  int r, g, b;
};

Pixel pixel_of(const RgbImage& image, int x, int y) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x));
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

/// Pixels of `area` for which `holds`.
template <class Holds>
int count_pixels(const RgbImage& image, const Rect& area, Holds&& holds) {
  int count = 0;
  for (int y = area.top; y < area.bottom(); ++y) {
    for (int x = area.left; x < area.right(); ++x) count += holds(pixel_of(image, x, y)) ? 1 : 0;
  }
  return count;
}

bool is_ink(const Pixel& p) { return p.r < 250; }
bool is_near(const Pixel& p, const Colour& colour) {
  const auto off = [](int byte, float channel) {
    return std::abs(static_cast<float>(byte) - 255 * channel) > 40;
  };
  return !off(p.r, colour.r) && !off(p.g, colour.g) && !off(p.b, colour.b);
}

RgbImage decoded(const std::string& bytes, png_uint_32 format, int channels) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0);
  CHECK(header.format == format);
  RgbImage image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.pixels.resize(static_cast<std::size_t>(channels) * header.width * header.height);
  header.format = format;
  REQUIRE(png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) != 0);
  return image;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

/// The check sum of the PNG standard, bit by bit.
std::uint32_t crc(const std::string& bytes, std::size_t from, std::size_t count) {
  std::uint32_t sum = ~0U;
  for (std::size_t i = from; i < from + count; ++i) {
    sum ^= static_cast<std::uint8_t>(bytes[i]);
    for (int k = 0; k < 8; ++k) sum = (sum & 1U) != 0 ? sum >> 1 ^ 0xEDB88320U : sum >> 1;
  }
  return ~sum;
}

/// Names of the chunks, "IHDR...IEND"; checks their sums on the way.
std::string chunks_of(const std::string& bytes) {
  std::string names;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    REQUIRE(at + 12 + length <= bytes.size());
    CHECK(big_endian(bytes, at + 8 + length) == crc(bytes, at + 4, length + 4));
    names += bytes.substr(at + 4, 4) + " ";
    at += 12 + length;
  }
  return names;
}

}  // namespace

TEST_CASE("A PNG is whole and decodes to the same pixels", "[picture]") {
  RgbImage rgb{37, 11, {}};
  for (int i = 0; i < 37 * 11 * 3; ++i) {
    rgb.pixels.push_back(static_cast<std::uint8_t>(i * 7 % 251));
  }
  const std::string bytes = encode_png(rgb);
  CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(big_endian(bytes, 16) == 37);
  CHECK(big_endian(bytes, 20) == 11);
  const std::string chunks = chunks_of(bytes);
  CHECK(chunks.find("IEND ") == chunks.size() - 5);
  CHECK(chunks.find("tIME") == std::string::npos);  // no time, no words: same pixels, same bytes
  CHECK(chunks.find("tEXt") == std::string::npos);
  CHECK(decoded(bytes, PNG_FORMAT_RGB, 3) == rgb);
  CHECK(encode_png(rgb) == bytes);

  const GreyImage grey{5, 3, {0, 1, 2, 3, 4, 50, 60, 70, 80, 90, 251, 252, 253, 254, 255}};
  CHECK(decoded(encode_png(grey), PNG_FORMAT_GRAY, 1).pixels == grey.pixels);
}

TEST_CASE("A PNG of an impossible picture is refused", "[picture]") {
  CHECK(kind_of([] { encode_png(RgbImage{}); }) == ErrorKind::Internal);
  CHECK(kind_of([] { encode_png(RgbImage{2, 2, {1, 2, 3}}); }) == ErrorKind::Internal);
  CHECK(kind_of([] { encode_png(GreyImage{-1, -1, {1}}); }) == ErrorKind::Internal);
}

TEST_CASE("A rendered ball covers the area of a disc in every view", "[picture]") {
  const RgbImage image = render_picture(ball(), {}, small());
  const RgbImage empty = render_picture({}, {}, small());  // names and lines
  const double radius = 0.5 * 0.86 * front_of(image).height;
  CHECK(count_pixels(image, views_of(image), is_ink) -
            count_pixels(empty, views_of(image), is_ink) ==
        Approx(4 * kPi * radius * radius).epsilon(0.02));
}

TEST_CASE("A rendered skeleton shows its colours, leaves and joints", "[picture]") {
  CurveSkeleton skeleton = rod();
  const RgbImage two = render_picture(ball(), skeleton, legible());
  const Rect front = front_of(two);
  const auto pixels_near = [&](const RgbImage& image, const Colour& colour) {
    return count_pixels(image, front, [&](const Pixel& p) { return is_near(p, colour); });
  };
  CHECK(pixels_near(two, radius_colour(0.25F)) > 10);
  CHECK(pixels_near(two, radius_colour(0.5F)) > 10);
  CHECK(pixels_near(two, kLeafColour) > 15);

  const RgbImage none = render_picture(ball(), {}, legible());
  CHECK(pixels_near(none, radius_colour(0.5F)) == 0);
  CHECK(pixels_near(none, kLeafColour) == 0);

  // A node in the middle of the rod is not marked.
  skeleton.nodes.push_back({{0, 0, 0}, 0.375});
  skeleton.edges = {{0, 2}, {1, 2}};
  const RgbImage bent = render_picture(ball(), skeleton, legible());
  CHECK(is_near(pixel_of(bent, front.width / 2, front.height / 2), radius_colour(0.5F)));

  // A third arm makes a joint of it.
  skeleton.nodes.push_back({{0, 0.5, 0}, 0.4});
  skeleton.edges = {{0, 2}, {1, 2}, {2, 3}};
  const auto white = [](const Pixel& p) { return p.r > 210 && p.g > 210 && p.b > 210; };
  const Rect middle{front.width / 2 - 1, front.height / 2 - 1, 2, 2};
  const RgbImage three = render_picture(ball(), skeleton, legible());
  CHECK(count_pixels(three, middle, white) == 4);
  CHECK(count_pixels(two, middle, white) == 0);
}

TEST_CASE("Nearer parts of the skeleton hide farther ones", "[picture]") {
  // Two crossing rods; the front view looks along the shortest side, z.
  const auto crossing = [](double z) {
    CurveSkeleton s;
    s.nodes = {{{-1, 0, z}, 0.1}, {{1, 0, z}, 0.1}, {{0, -1, -z}, 0.3}, {{0, 1, -z}, 0.3}};
    s.edges = {{0, 1}, {2, 3}};
    return render_picture({}, s, legible());
  };
  const RgbImage across = crossing(0.4);
  const RgbImage upright = crossing(-0.4);
  const int x = front_of(across).width / 2;
  const int y = front_of(across).height / 2;
  const Pixel thin = pixel_of(across, x, y);
  const Pixel thick = pixel_of(upright, x, y);
  CHECK(thin.g > thick.g + 60);    // amber in front of violet, and the other way round
  for (int i = -8; i <= 8; ++i) {  // and no outline from behind cuts through what is in front
    CHECK(pixel_of(across, x + i, y).r > 150);
  }
}

TEST_CASE("The picture is the same twice and for any number of threads", "[picture]") {
  const Shape shape = ball();
  const CurveSkeleton skeleton = rod();
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    // Had something capped the threads for the whole process, this test would mean nothing.
    REQUIRE(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) ==
            threads);
    return encode_png(render_picture(shape, skeleton, small()));
  };
  const std::string one = with_threads(1);
  CHECK((with_threads(1) == one));  // as a whole: nobody wants to read the bytes of a PNG
  CHECK((with_threads(4) == one));
}

TEST_CASE("The size, place and units of a shape do not change its picture", "[picture]") {
  const RgbImage image = render_picture(ball(), rod(), small());
  for (const double factor : {0x1p-900, 0x1p60, 0x1p900}) {
    Shape shape = ball();
    CurveSkeleton skeleton = rod();
    for (Vec3& p : shape.points) p = p * factor;
    for (auto& node : skeleton.nodes) {
      node.position = node.position * factor;
      node.radius *= factor;
    }
    const RgbImage scaled_image = render_picture(shape, skeleton, small());
    const std::size_t views =  // not the legend: it names the radii
        image.pixels.size() - static_cast<std::size_t>(3 * image.width * kLegend);
    CHECK(std::equal(image.pixels.begin(),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>(views),
                     scaled_image.pixels.begin()));
  }
}

TEST_CASE("Points that no triangle uses do not count", "[picture]") {
  Shape shape = ball();
  shape.points.push_back({1e308, -1e308, 7});
  CHECK(render_picture(shape, rod(), small()) == render_picture(ball(), rod(), small()));
}

TEST_CASE("Doubled, flipped and unwelded triangles do not change the picture", "[picture]") {
  const Shape once = ball();
  Shape doubled = once;
  Shape soup;
  for (const auto& [a, b, c] : once.triangles) {
    doubled.triangles.push_back({a, c, b});
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t i : {a, b, c}) soup.points.push_back(once.points[i]);
    const std::uint32_t turn = first % 2;  // every other triangle the other way round
    soup.triangles.push_back({first, first + 1 + turn, first + 2 - turn});
  }
  const RgbImage image = render_picture(once, {}, small());
  for (const Shape& other : {doubled, soup}) {
    const RgbImage same = render_picture(other, {}, small());
    int differing = 0;  // but for the last bits of normals and depths
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      differing += std::abs(image.pixels[i] - same.pixels[i]) > 2 ? 1 : 0;
    }
    CHECK(differing < 3 * image.width * image.height / 1000);
  }
}

TEST_CASE("A cloud of points is drawn as discs", "[picture]") {
  Shape cloud = ball();
  cloud.triangles.clear();
  const RgbImage image = render_picture(cloud, {}, small());
  CHECK(count_pixels(image, views_of(image), is_ink) > scaled(4000, 500));
}

TEST_CASE("Degenerate shapes and skeletons are drawn", "[picture]") {
  const Shape flat{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Shape needle{{{0, 0, 0}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}};
  const Shape place{{{5, 5, 5}}, {{0, 0, 0}}};
  const Shape point{{{5, 5, 5}}, {}};
  const CurveSkeleton node{{{{1, 0.5, 0}, 0.2}}, {}};
  for (const Shape& shape : {flat, needle, place, point, Shape{}}) {
    for (const CurveSkeleton& skeleton : {node, CurveSkeleton{}}) {
      const RgbImage image = render_picture(shape, skeleton, {160, 120});
      CHECK(image.width == 160);
      CHECK(image.height == 120);
      CHECK(image.pixels.size() == 160 * 120 * 3);
    }
  }
  // The flat one is seen from its broad side.
  const RgbImage image = render_picture(flat, {}, small());
  const Rect front = front_of(image);
  CHECK(count_pixels(image, front, is_ink) > front.width * front.height / 5);
}

TEST_CASE("A skeleton far from the shape does not hide the shape", "[picture]") {
  const RgbImage near = render_picture(ball(), {}, small());
  const int ink = count_pixels(near, views_of(near), is_ink);
  for (const double far : {1e3, 1e30, 1e300}) {
    const CurveSkeleton skeleton{{{{-far, far, 0}, 1}, {{far, far, 2}, 2}}, {{0, 1}}};
    const RgbImage image = render_picture(ball(), skeleton, small());
    CHECK(count_pixels(image, views_of(image), is_ink) == Approx(ink).epsilon(0.05));
  }
}

TEST_CASE("One view alone takes the whole picture", "[picture]") {
  RenderOptions options = small();
  options.legend = false;
  const auto ink = [&](ViewChoice view) {
    options.view = view;
    const RgbImage image = render_picture(ball(), {}, options);
    return count_pixels(image, {0, 0, image.width, image.height}, is_ink);
  };
  const double radius = 0.5 * 0.86 * options.height;
  for (const auto view :
       {ViewChoice::Front, ViewChoice::Side, ViewChoice::Top, ViewChoice::ThreeQuarter})
    CHECK(ink(view) == Approx(kPi * radius * radius).epsilon(0.02));
  CHECK(ink(ViewChoice::All) == Approx(kPi * radius * radius).epsilon(0.02));  // a quarter each
}

TEST_CASE("The background is what is asked for, and words are seen on it", "[picture]") {
  RenderOptions options = small();
  options.background = from_bytes(10, 20, 30);
  const RgbImage dark = render_picture(ball(), rod(), options);
  const Pixel corner = pixel_of(dark, dark.width - 1, 0);
  CHECK((corner.r == 10 && corner.g == 20 && corner.b == 30));
  const Rect legend{0, dark.height - kLegend, dark.width, kLegend};
  CHECK(count_pixels(dark, legend, [](const Pixel& p) { return p.r > 190; }) > 20);
}

TEST_CASE("An SVG has a line for every edge and a ball for every end", "[picture]") {
  const auto count = [](const std::string& text, const std::string& word) {
    int found = 0;
    for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1))
      ++found;
    return found;
  };
  const std::string svg = render_svg(ball(), rod(), legible());
  CHECK(count(svg, "<g ") == 4);
  CHECK(count(svg, "<line ") == 2 * 4);    // the body and the line
  CHECK(count(svg, "<circle ") == 4 * 4);  // both ends, in both
  CHECK(count(svg, "nan") == 0);
  CHECK(render_svg(ball(), rod(), legible()) == svg);
  RenderOptions one{800, 600, ViewChoice::Top, {1, 1, 1}, false};
  const std::string top = render_svg({}, rod(), one);
  CHECK(count(top, "<g ") == 1);
  CHECK(count(top, "<text ") == 0);
  CHECK(count(render_svg({}, {}, one), "<line ") == 0);
  // A node at infinity and beyond is somewhere outside.
  const CurveSkeleton far{{{{-1e300, 0, 0}, 1}, {{1e300, 1, 2}, 2}}, {{0, 1}}};
  CHECK(count(render_svg(ball(), far, one), "inf") == 0);
}

TEST_CASE("Sizes of pictures out of range are refused", "[picture]") {
  CHECK(kind_of([] { render_picture({}, {}, {0, 100}); }) == ErrorKind::Usage);
  CHECK(kind_of([] { render_picture({}, {}, {100, 1 << 20}); }) == ErrorKind::Usage);
}

TEST_CASE("Figures stand upright in the front view, animals of z-up files too", "[picture]") {
  const auto box = [](double x, double y, double z) {
    Shape shape;
    for (int i = 0; i < 8; ++i) {
      shape.points.push_back({(i & 1) != 0 ? x : 0, (i & 2) != 0 ? y : 0, (i & 4) != 0 ? z : 0});
    }
    shape.triangles = {{0, 3, 5}, {6, 3, 5}, {1, 2, 7}, {0, 4, 7}};
    return shape;
  };
  const auto up = [](const Shape& shape) { return pose_of(shape, {}).axes.y; };
  CHECK(up(box(2, 5, 1)) == Vec3{0, 1, 0});  // a man, y up
  CHECK(up(box(5, 2, 1)) == Vec3{0, 1, 0});
  CHECK(up(box(2, 1, 5)) == Vec3{0, 0, 1});  // a man, z up
  CHECK(up(box(1, 5, 3)) == Vec3{0, 0, 1});  // a horse along y, z up
  CHECK(up(box(1, 3, 5)) == Vec3{0, 1, 0});  // a horse along z, y up
}

TEST_CASE("A turned shape is framed by its own axes", "[picture]") {
  Shape shape = ball();
  const Frame turned{normalized(Vec3{1, 1, 1}), normalized(Vec3{1, -1, 0}),
                     normalized(Vec3{1, 1, -2})};
  for (Vec3& p : shape.points) p = from_frame(turned, {8 * p.x, p.y, p.z});
  const Vec3 right = pose_of(shape, {}).axes.x;
  const Vec3 up = pose_of(shape, {}).axes.y;
  CHECK(std::max(std::abs(dot(right, turned.x)), std::abs(dot(up, turned.x))) > 0.999);
}

TEST_CASE("Both colour maps are ordered by lightness", "[picture]") {
  const auto lightness = [](const Colour& c) {
    return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
  };
  for (int i = 0; i < 100; ++i) {
    const float t = static_cast<float>(i) / 100.0F;
    CHECK(lightness(radius_colour(t)) > lightness(radius_colour(t + 0.01F)));
    CHECK(lightness(heat_colour(t)) < lightness(heat_colour(t + 0.01F)));
  }
  CHECK(radius_colour(-1) == radius_colour(0));
  CHECK(radius_colour(2) == radius_colour(1));
}

TEST_CASE("Text takes the room it says", "[picture]") {
  const std::string text = "radius 0.25 (joints)";
  const float dot = 2;
  Canvas canvas(static_cast<int>(text_width(text, dot)) + 20, 40, {1, 1, 1});
  draw_text(canvas, 10, 10, text, dot, {0, 0, 0});
  const RgbImage image = to_image(canvas);
  const int right = 11 + static_cast<int>(text_width(text, dot));
  const int bottom = 11 + static_cast<int>(text_height(dot));
  CHECK(count_pixels(image, canvas.bounds(), is_ink) > 200);
  CHECK(count_pixels(image, {9, 9, right - 9, bottom - 9}, is_ink) ==
        count_pixels(image, canvas.bounds(), is_ink));
}

TEST_CASE("Blanks leave no ink, letters leave some, at any size", "[picture]") {
  for (const float dot : {0.7F, 1.0F, 1.5F, 3.0F}) {
    Canvas canvas(60, 40, {1, 1, 1});
    draw_text(canvas, 5, 5, " ", dot, {0, 0, 0});
    CHECK(to_image(canvas).pixels == std::vector<std::uint8_t>(60 * 40 * 3, 255));
    draw_text(canvas, 5, 5, "a", dot, {0, 0, 0});
    CHECK(count_pixels(to_image(canvas), canvas.bounds(), is_ink) > 5);
  }
}

TEST_CASE("Masks become images", "[picture]") {
  const std::vector<std::uint8_t> bytes = {0, 1, 2, 0, 0, 255};
  CHECK(mask_image(bytes, 3, 2) == GreyImage{3, 2, {0, 255, 255, 0, 0, 255}});

  const std::vector<std::uint64_t> words = {std::uint64_t{1} << 63, 2, 1, 0};
  const GreyImage image = bit_mask_image(words, 66, 2);
  REQUIRE(image.pixels.size() == 132);
  for (std::size_t i = 0; i < 132; ++i) {
    CHECK((image.pixels[i] == 255) == (i == 63 || i == 65 || i == 66));
  }
  CHECK(kind_of([&] { mask_image(bytes, 2, 2); }) == ErrorKind::Internal);
  CHECK(kind_of([&] { bit_mask_image(words, 64, 2); }) == ErrorKind::Internal);
}

TEST_CASE("Amounts become grey and heat", "[picture]") {
  const std::vector<std::uint16_t> distances = {0, 15, 30, 60};
  CHECK(grey_image(distances, 4, 1).pixels == std::vector<std::uint8_t>{0, 64, 128, 255});
  CHECK(grey_image(std::vector<std::uint16_t>(4), 2, 2).pixels == std::vector<std::uint8_t>(4));

  const RgbImage linear = heat_image(distances, 4, 1);
  const RgbImage root = heat_image(distances, 4, 1, Brightness::Root);
  CHECK(pixel_of(linear, 3, 0).r == pixel_of(root, 3, 0).r);
  CHECK(pixel_of(root, 1, 0).r == pixel_of(linear, 2, 0).r);  // sqrt(1/4) = 1/2
}

TEST_CASE("A medial axis lies over its silhouette", "[picture]") {
  const std::vector<std::uint64_t> silhouette = {0, 0b01110, 0};
  const std::vector<AxisPixel> axis = {{2, 1, 6}, {-1, 0, 3}, {5, 0, 3}, {0, 3, 3}};
  const RgbImage image = axis_image(silhouette, 5, 3, axis);
  CHECK(pixel_of(image, 0, 0).r == 255);
  CHECK(pixel_of(image, 1, 1).r == 214);
  CHECK(is_near(pixel_of(image, 2, 1), radius_colour(1)));
}

TEST_CASE("A slab of a grid shows its greatest amounts, up is up", "[picture]") {
  const std::vector<GridCell> cells = {{1, 0, 2, 5}, {1, 0, 3, 9}, {3, 4, 2, 9}, {2, 2, 9, 50}};
  GridSlab slab{4, 5, 10, GridAxis::Z, 2, 3};
  RgbImage image = slab_image(cells, slab);
  CHECK(image.width == 4);
  CHECK(image.height == 5);
  CHECK(is_near(pixel_of(image, 3, 0), heat_colour(1)));
  CHECK(is_near(pixel_of(image, 1, 4), heat_colour(std::sqrt(5.0F / 9.0F))));
  CHECK(pixel_of(image, 2, 2).r == 0);

  slab.last = 4;
  image = slab_image(cells, slab);
  CHECK(is_near(pixel_of(image, 1, 4), heat_colour(1)));

  image = slab_image(cells, {4, 5, 10, GridAxis::X, 0, 4});
  CHECK(image.width == 5);
  CHECK(image.height == 10);
  CHECK(is_near(pixel_of(image, 2, 0), heat_colour(1)));
}

TEST_CASE("A contact sheet holds all its images and their labels", "[picture]") {
  std::vector<LabelledImage> images;
  for (int i = 0; i < 5; ++i) {
    RgbImage image{60, 40, std::vector<std::uint8_t>(60 * 40 * 3, 0)};
    image.pixels[0] = static_cast<std::uint8_t>(i);
    images.push_back({"view " + std::to_string(i), std::move(image)});
  }
  const RgbImage sheet = contact_sheet(images, 2);
  CHECK(sheet.width >= 120);
  CHECK(sheet.height >= 120);
  const Rect all{0, 0, sheet.width, sheet.height};
  CHECK(count_pixels(sheet, all, [](const Pixel& p) { return p.g == 0; }) == 5 * 60 * 40);
  CHECK(count_pixels(sheet, all, [](const Pixel& p) { return p.g > 0 && p.g < 120; }) > 5 * 20);
  CHECK(contact_sheet(images).width > sheet.width);
  CHECK(kind_of([] { contact_sheet({}); }) == ErrorKind::Internal);
}
