// Whole-shape topology on a folder of real shapes beside the project, where there is one: see
// MARROW_SHARED_DIR in CMakeLists.txt. Its manifest.json says what each skeleton must look like.
#include <marrow/extract.hpp>
#include <marrow/shape_io.hpp>
#include <marrow/volume_io.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

#include "catch.hpp"
#include "scale.hpp"

using namespace marrow;
using nlohmann::json;

namespace {

const std::set<std::string> kGroups{"closed",   "genus", "quad",          "hole",       "analytic",
                                    "rotation", "noise", "triangle-soup", "decimation", "volume"};

/// Wrong ones of the 93 that may be, today one is.
constexpr int kMostWrong = 2;

/// Larger files are left out of the sanitized build, where each costs minutes.
constexpr int kMostFaces = scaled(100'000'000, 2'500);

/// A number, a pair of the least and the most, or a string where experts disagree.
bool agrees(int got, const json& expected) {
  if (expected.is_number()) return got == expected.get<int>();
  if (!expected.is_array()) return true;
  return got >= expected[0].get<int>() && got <= expected[1].get<int>();
}

/// Of what is in a file of the folder; volumes stand beside the header that describes them.
CurveSkeleton skeleton_of(const std::filesystem::path& file, const ExtractOptions& options) {
  if (!volume_format_of(file.string())) return extract(read_shape(file.string()), options);
  const std::string name = file.filename().string();
  return extract(read_volume(file.parent_path() / (name.substr(0, name.find('.')) + ".nhdr")),
                 options);
}

/// What is wrong with the skeleton; empty when nothing is.
std::string fault(const CurveSkeleton& s, const json& expected) {
  std::string words;
  const auto judge = [&](const char* what, int got) {
    if (!agrees(got, expected.at(what)))
      words +=
          std::string(" ") + what + " " + std::to_string(got) + " not " + expected.at(what).dump();
  };
  judge("components", component_count(s));
  judge("cycles", cycle_count(s));
  judge("tips", leaf_count(s));
  return words;
}

}  // namespace

TEST_CASE("real shapes have the topology that a person sees", "[extract][meshes]") {
  const std::filesystem::path folder = std::filesystem::path(MARROW_SHARED_DIR) / "meshes";
  std::ifstream file(folder / "manifest.json");
  if (!file) {
    WARN("skipped: there is no " << (folder / "manifest.json").string());
    return;
  }
  const json items = json::parse(file).at("items");
  const ExtractOptions options = defaults_or_small(128, 64);
  int judged = 0, wrong = 0;
  std::string faults;
  for (const json& item : items) {
    if (kGroups.count(item.at("group").get<std::string>()) == 0) continue;
    if (item.value("F", 0) > kMostFaces) continue;
    const auto name = item.at("file").get<std::string>();
    INFO(name);
    CurveSkeleton s;
    CHECK_NOTHROW(s = skeleton_of(folder / name, options));
    const std::string words = fault(s, item.at("expected"));
    ++judged;
    if (words.empty()) continue;
    ++wrong;
    faults += "\n" + name + ":" + words;
  }
  INFO(wrong << " of " << judged << " are wrong:" << faults);
  CHECK(judged > 0);
  // Coarse grids lose details: the sanitized build only sees that nothing breaks.
  if (scaled(1, 0) == 1) CHECK(wrong <= kMostWrong);
  if (wrong > 0) WARN(wrong << " of " << judged << " are wrong:" << faults);
}
