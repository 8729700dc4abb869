// marrow compare: how far two skeletons are apart, and how their graphs differ.
#include <marrow/compare.hpp>
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "limits.hpp"
#include "statistics.hpp"

namespace marrow {

namespace {

struct CompareRequest {
  std::string first, second, from;
  bool json = false;
  Limits limits;
};

CurveSkeleton read(const CompareRequest& request, const std::string& path, bool is_named) {
  // Radii do not count here, so that files without any will do.
  return skeleton_of(read_input(path, is_named ? request.from : "", request.limits.read), 1);
}

/// In units, and in percent of the diagonal where there is one.
Statistics measure(double value, double diagonal) {
  Statistics s;
  s["distance"] = value;
  if (diagonal > 0) s["percent"] = 100 * value / diagonal;
  return s;
}

Statistics statistics_of(const LineDistance& distance, double diagonal) {
  Statistics s;
  s["mean"] = measure(distance.mean, diagonal);
  s["hausdorff"] = measure(distance.most, diagonal);
  return s;
}

Statistics counts_of(const CurveSkeleton& skeleton) {
  Statistics s;
  s["components"] = component_count(skeleton);
  s["cycles"] = cycle_count(skeleton);
  s["leaves"] = leaf_count(skeleton);
  s["joints"] = joint_count(skeleton);
  s["branches"] = branches(skeleton).size();
  s["nodes"] = skeleton.nodes.size();
  s["length"] = total_length(skeleton);
  return s;
}

Statistics describe(const CompareRequest& request, const CurveSkeleton& first,
                    const CurveSkeleton& second) {
  const Comparison c = compare(first, second);
  Statistics s;
  s["first"] = request.first;
  s["second"] = request.second;
  s["diagonal"] = c.diagonal;
  s["first_to_second"] = statistics_of(c.there, c.diagonal);
  s["second_to_first"] = statistics_of(c.back, c.diagonal);
  s["both_ways"] = statistics_of({c.mean(), c.hausdorff()}, c.diagonal);
  s["counts"]["first"] = counts_of(first);
  s["counts"]["second"] = counts_of(second);
  bool is_same = true;
  for (const char* count : {"components", "cycles", "leaves", "joints", "branches"})
    is_same = is_same && s["counts"]["first"][count] == s["counts"]["second"][count];
  s["same_topology"] = is_same;
  return s;
}

std::string words(const char* name, const std::string& first, const std::string& second,
                  const std::string& third) {
  char line[160];
  std::snprintf(line, sizeof line, "%-16s%-24s%-24s%s", name, first.c_str(), second.c_str(),
                third.c_str());
  std::string text(line);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string words_of(const Statistics& measure) {
  char text[64];
  if (measure.contains("percent"))
    std::snprintf(text, sizeof text, "%.4g (%.3g %%)", measure["distance"].get<double>(),
                  measure["percent"].get<double>());
  else
    std::snprintf(text, sizeof text, "%.4g", measure["distance"].get<double>());
  return text;
}

std::string table_of(const Statistics& s) {
  std::string table = words("distance", "first to second", "second to first", "both ways");
  for (const char* measure : {"mean", "hausdorff"})
    table += words(measure, words_of(s["first_to_second"][measure]),
                   words_of(s["second_to_first"][measure]), words_of(s["both_ways"][measure]));
  table += "\n" + words("count", "first", "second", "difference");
  for (const auto& [key, first] : s["counts"]["first"].items()) {
    const Statistics& second = s["counts"]["second"][key];
    char difference[32], a[32], b[32];
    std::snprintf(difference, sizeof difference, "%+.6g",
                  second.get<double>() - first.get<double>());
    std::snprintf(a, sizeof a, "%.6g", first.get<double>());
    std::snprintf(b, sizeof b, "%.6g", second.get<double>());
    table += words(key.c_str(), a, b, first == second ? "" : difference);
  }
  return table + "\n" + (s["same_topology"].get<bool>() ? "same" : "other") + " topology\n";
}

void run_compare(const CompareRequest& request) {
  start_clock(request.limits, request.first);
  if (request.first == "-" && request.second == "-")
    throw Error(ErrorKind::Usage, "only one of A and B can be standard input");
  const bool first_is_named = request.second != "-";
  const CurveSkeleton first = read(request, request.first, first_is_named);
  const CurveSkeleton second = read(request, request.second, !first_is_named);
  const Statistics statistics = describe(request, first, second);
  write_file("-", request.json ? to_json(statistics) : table_of(statistics));
}

}  // namespace

void add_compare_command(CLI::App& program) {
  const auto request = std::make_shared<CompareRequest>();
  CLI::App* verb = program.add_subcommand("compare", "How far two skeletons are apart");
  verb->add_option("A", request->first, "Skeleton, all that marrow convert reads, or -")
      ->required()
      ->type_name("");
  verb->add_option("B", request->second, "The other")->required()->type_name("");
  add_format_option(*verb, "--from", request->from, "Format of the input that is -, else of A",
                    readable_skeleton_formats());
  verb->add_flag("--json", request->json, "JSON instead of a table");
  add_limit_options(*verb, request->limits);
  verb->footer(
      "Distances are those of the lines of one from the lines of the other, in the units of the\n"
      "files and in percent of the diagonal of the box around A: their mean over the length, and\n"
      "the greatest (Hausdorff). The topology is the same when components, cycles, leaves, joints\n"
      "and branches are as many.\n"
      "\n"
      "Examples:\n"
      "  marrow compare truth.skel horse.skel\n"
      "  marrow compare theirs.polylines.txt ours.vtp --json\n");
  verb->callback([request] { run_compare(*request); });
}

}  // namespace marrow
