// marrow merge: the results of all shards of a batch as one.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <memory>

#include "command.hpp"
#include "merge_rows.hpp"

namespace marrow {

namespace {

struct MergeRequest {
  std::vector<std::string> folders, outputs;
  std::size_t pictures = 200;
  bool with_run = false;
};

void write_merged(const std::string& path, const MergedRows& rows, const MergeRequest& request) {
  const std::string extension = path == "-" ? "jsonl" : extension_of(path);
  if (extension == "jsonl") write_json_lines(path, rows, request.with_run);
  if (extension == "csv") write_csv(path, rows, request.with_run);
  if (extension == "html") write_report(path, rows, request.pictures);
}

void run_merge(const MergeRequest& request) {
  for (const std::string& path : request.outputs) {
    const std::string extension = extension_of(path);
    if (path != "-" && extension != "jsonl" && extension != "csv" && extension != "html")
      throw Error(ErrorKind::Unsupported,
                  path + ": merged results are .jsonl, .csv or .html files");
  }
  check_outputs(request.outputs, {});
  const MergedRows rows(request.folders);
  if (rows.torn() > 0)
    warn("lines of results that are torn and do not count: " + std::to_string(rows.torn()));
  for (const std::string& path : request.outputs) write_merged(path, rows, request);
}

}  // namespace

void add_merge_command(CLI::App& program) {
  const auto request = std::make_shared<MergeRequest>();
  CLI::App* verb = program.add_subcommand("merge", "The results of a batch, of all its shards");
  verb->add_option("DIR", request->folders, "Folders that marrow batch has written to")
      ->required()
      ->type_name("");
  verb->add_option("-o,--output", request->outputs,
                   "File for the rows: .jsonl, .csv, or .html for a report; - is standard output;\n"
                   "may be given more than once")
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
  verb->add_flag("--with-run", request->with_run,
                 "Also what differs from run to run: times, memory, host, attempt");
  verb->add_option("--pictures", request->pictures, "Pictures in a report at most")
      ->type_name("N")
      ->capture_default_str();
  verb->footer(
      "One row for each shape, by name; of shapes that were tried again the last. Without\n"
      "--with-run the bytes are the same for any number of shards and jobs.\n"
      "\n"
      "Examples:\n"
      "  marrow merge out -o results.jsonl -o results.csv\n"
      "  marrow merge out-* -o report.html\n"
      "  marrow merge out -o - | grep '\"status\":\"timeout\"'\n");
  verb->callback([request] { run_merge(*request); });
}

}  // namespace marrow
