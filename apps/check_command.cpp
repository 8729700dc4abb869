// marrow check: how good a skeleton is for its shape, and whether that is good enough.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/quality.hpp>

#include <cstdio>
#include <memory>
#include <optional>

#include "command.hpp"
#include "pair_input.hpp"
#include "statistics.hpp"

namespace marrow {

namespace {

/// What the figures must keep to; shares in percent.
struct Gates {
  std::optional<double> outside, centredness, reconstruction, coverage, radius_error;
  std::optional<int> components, cycles;
  bool same_topology = false;
};

struct CheckRequest {
  PairRequest pair;
  Gates gates;
  bool json = false;
};

/// Nothing is null, which tables show as n/a.
Statistics percent(const std::optional<double>& share) {
  return share ? Statistics(100 * *share) : Statistics();
}
Statistics count(const std::optional<int>& n) { return n ? Statistics(*n) : Statistics(); }

void add_balls(Statistics& s, const SkeletonQuality& q) {
  const auto of = [](const auto& all, auto part) {
    return percent(all ? std::optional((*all).*part) : std::nullopt);
  };
  s["coverage_percent"] = of(q.reconstruction, &Reconstruction::covered);
  s["reconstruction_percent"] = of(q.reconstruction, &Reconstruction::mean);
  s["reconstruction_p95_percent"] = of(q.reconstruction, &Reconstruction::p95);
  s["reconstruction_max_percent"] = of(q.reconstruction, &Reconstruction::most);
  s["inscribed_reconstruction_percent"] = of(q.inscribed_reconstruction, &Reconstruction::mean);
  s["radius_error_percent"] = percent(q.radius_error);
}

Statistics statistics_of(const CurveSkeleton& skeleton, const SkeletonQuality& q) {
  Statistics s;
  s["components"] = component_count(skeleton);
  s["shape_components"] = count(q.shape_components);
  s["cycles"] = cycle_count(skeleton);
  s["shape_cycles"] = count(q.shape_cycles);
  s["leaves"] = leaf_count(skeleton);
  s["joints"] = joint_count(skeleton);
  s["length_percent"] = 100 * q.length;
  s["outside_percent"] = percent(q.outside);
  s["outside_max_percent"] = percent(q.outside_most);
  s["centredness"] = q.centredness ? Statistics(q.centredness->mean) : Statistics();
  s["centredness_p90"] = q.centredness ? Statistics(q.centredness->p90) : Statistics();
  s["centredness_samples"] = q.centredness ? q.centredness->samples : std::size_t{0};
  add_balls(s, q);
  return s;
}

std::string short_text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value);
  return digits;
}

struct Figure {
  const char *key, *words, *unit;
};

/// Collects what fails, each in a few words.
class Verdict {
 public:
  explicit Verdict(const Statistics& figures) : figures_(figures) {}

  void at_most(const Figure& figure, const std::optional<double>& most) {
    if (most && is_known(figure) && !(figures_[figure.key].get<double>() <= *most))
      add(words(figure) + " is more than " + short_text(*most) + figure.unit);
  }
  void at_least(const Figure& figure, const std::optional<double>& least) {
    if (least && is_known(figure) && !(figures_[figure.key].get<double>() >= *least))
      add(words(figure) + " is less than " + short_text(*least) + figure.unit);
  }
  void equal(const char* key, const std::optional<int>& wanted) {
    if (wanted && figures_[key].get<int>() != *wanted)
      add(std::string(key) + " " + figures_[key].dump() + " instead of " + std::to_string(*wanted));
  }
  void same(const char* key, const char* of_shape) {
    if (figures_[of_shape].is_null())
      add(std::string(key) + " cannot be told of a shape that is no closed manifold");
    else
      equal(key, figures_[of_shape].get<int>());
  }

  const std::string& failures() const { return failures_; }

 private:
  bool is_known(const Figure& figure) {
    const bool known = !figures_[figure.key].is_null();
    if (!known) add(std::string(figure.words) + " cannot be told of this shape");
    return known;
  }
  std::string words(const Figure& figure) const {
    return std::string(figure.words) + " " + short_text(figures_[figure.key]) + figure.unit;
  }
  void add(const std::string& words) { failures_ += (failures_.empty() ? "" : "; ") + words; }

  const Statistics& figures_;
  std::string failures_;
};

std::string failures_of(const Statistics& figures, const Gates& gates) {
  Verdict verdict(figures);
  verdict.at_most({"outside_percent", "outside", " %"}, gates.outside);
  verdict.at_most({"centredness", "centredness", ""}, gates.centredness);
  verdict.at_most({"reconstruction_percent", "reconstruction", " %"}, gates.reconstruction);
  verdict.at_least({"coverage_percent", "coverage", " %"}, gates.coverage);
  verdict.at_most({"radius_error_percent", "radius error", " %"}, gates.radius_error);
  if (gates.same_topology) verdict.same("components", "shape_components");
  if (gates.same_topology) verdict.same("cycles", "shape_cycles");
  verdict.equal("components", gates.components);
  verdict.equal("cycles", gates.cycles);
  return verdict.failures();
}

SkeletonQuality measure(const InputFile& shape, const VolumeRequest& volume,
                        const CurveSkeleton& skeleton, const std::string& skeleton_name) {
  const auto input = shape_or_volume_of(shape, volume);
  try {
    return std::visit([&](const auto& any) { return measure_quality(any, skeleton); }, input);
  } catch (const Error& e) {
    throw Error(e.kind(),
                (e.kind() == ErrorKind::Malformed ? skeleton_name : shape.name) + ": " + e.what());
  }
}

void run_check(const CheckRequest& request) {
  start_clock(request.pair);
  const InputFile shape = read_shape_of(request.pair);
  const InputFile file = read_skeleton_of(request.pair);
  const CurveSkeleton skeleton = skeleton_of(file);
  const SkeletonQuality quality = measure(shape, request.pair.volume, skeleton, file.name);

  Statistics figures = statistics_of(skeleton, quality);
  const std::string failures = failures_of(figures, request.gates);
  Statistics all;
  all["shape"] = shape.name;
  all["skeleton"] = file.name;
  all.update(figures);
  write_file("-", request.json ? to_json(all) : to_table(all));
  if (!failures.empty()) throw Error(ErrorKind::CheckFailed, file.name + ": " + failures);
}

void add_gates(CLI::App& verb, Gates& gates) {
  const auto add = [&](const char* name, auto& value, const char* words, const char* type) {
    verb.add_option(name, value, words)
        ->check(CLI::Range(0.0, 1e9).description(""))
        ->type_name(type)
        ->group("Gates (exit status 10)");
  };
  add("--max-outside", gates.outside, "Share of the lines' length outside the shape", "PERCENT");
  add("--max-centredness", gates.centredness,
      "Mean of |a - b| / (a + b) for opposite distances to the surface; 0 is centred", "X");
  add("--max-reconstruction", gates.reconstruction,
      "Mean distance from the surface to the balls, of the diagonal", "PERCENT");
  add("--min-coverage", gates.coverage,
      "Share of the surface within the balls, or at most 1 % of the diagonal outside", "PERCENT");
  add("--max-radius-error", gates.radius_error,
      "Mean difference between radii and distances to the surface, of the diagonal", "PERCENT");
  add("--components", gates.components, "Connected pieces of the skeleton, exactly", "N");
  add("--cycles", gates.cycles, "Independent cycles of the skeleton, exactly", "N");
  verb.add_flag("--same-topology", gates.same_topology,
                "As many components and cycles as a closed manifold has parts and handles, or a\n"
                "volume parts and tunnels")
      ->group("Gates (exit status 10)");
}

}  // namespace

void add_check_command(CLI::App& program) {
  const auto request = std::make_shared<CheckRequest>();
  CLI::App* verb = program.add_subcommand("check", "How good a skeleton is for its shape");
  verb->add_flag("--json", request->json, "JSON instead of a table; what is not defined is null");
  add_gates(*verb, request->gates);
  add_pair_options(*verb, request->pair);
  verb->footer(
      "Lengths are in percent of the diagonal of the shape's box. What the shape does not define\n"
      "is n/a: what is outside of a point cloud, the handles of an open surface. A gate on it\n"
      "fails.\n"
      "\n"
      "Examples:\n"
      "  marrow check horse.obj horse.skel\n"
      "  marrow check horse.obj horse.skel --same-topology --max-outside 0.5 --max-centredness "
      "0.2\n"
      "  marrow extract scan.ply -o - --to skel | marrow check scan.ply - --from skel --cycles "
      "0\n");
  verb->callback([request] { run_check(*request); });
}

}  // namespace marrow
