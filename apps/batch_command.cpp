// marrow batch: the curve-skeletons of many shapes.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <algorithm>
#include <memory>
#include <thread>

#include "batch_run.hpp"
#include "command.hpp"

namespace marrow {

namespace {

struct BatchWords {
  BatchRequest request;
  std::vector<std::string> formats{"skel"};
  std::string shard;
  std::uint64_t megabytes = 0;
};

/// Each format once.
std::vector<std::string> without_repeats(const std::vector<std::string>& formats) {
  std::vector<std::string> once;
  for (const std::string& format : formats)
    if (std::find(once.begin(), once.end(), format) == once.end()) once.push_back(format);
  return once;
}

void run_words(BatchWords& words) {
  BatchRequest& request = words.request;
  if (request.sources.inputs.empty() && request.sources.manifest.empty())
    throw Error(ErrorKind::Usage,
                "no shapes: name files, folders or --manifest; see marrow batch "
                "--help");
  request.outputs.formats = without_repeats(words.formats);
  request.sources.without = request.outputs.folder;
  if (!words.shard.empty()) request.shard = shard_of(words.shard);
  request.max_memory = words.megabytes << 20;
  if (request.jobs == 0)
    request.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (const int status = run_batch(request); status != 0) throw ExitStatus{status};
}

void add_run_options(CLI::App& verb, BatchWords& words) {
  BatchRequest& request = words.request;
  verb.add_option("--format", words.formats, "Formats of the skeletons, see marrow convert --help")
      ->delimiter(',')
      ->check(CLI::IsMember(skeleton_formats()).description(""))
      ->type_name("EXT,EXT")
      ->capture_default_str();
  verb.add_flag("--render", request.outputs.with_picture, "A picture of each as well");
  verb.add_option("--map", request.outputs.map_format,
                  "A map of each surface to its skeleton as well")
      ->check(CLI::IsMember({"csv", "json", "ply"}).description(""))
      ->type_name("csv|json|ply");
  verb.add_option("--jobs", request.jobs, "Shapes at a time, 0 for as many as there are cores")
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--shard", words.shard, "Only every Nth shape, from I on: 0/N to N-1/N")
      ->type_name("I/N");
  CLI::Option* const resume = verb.add_flag(
      "--resume", request.resume,
      "Go on with the results in DIR: what is done stays, while its bytes, options and\n"
      "version are the same");
  verb.add_flag("--retry", request.retry, "With --resume: do what failed again")->needs(resume);
  verb.add_flag("--quiet", request.quiet, "Say nothing but errors");
}

void add_options(CLI::App& verb, BatchWords& words) {
  BatchRequest& request = words.request;
  verb.add_option("INPUT", request.sources.inputs,
                  "Shapes, folders of shapes, or patterns like 'scans/*.ply'")
      ->type_name("");
  verb.add_option("--manifest", request.sources.manifest,
                  "File with a path on each line, or a JSON object with \"path\", and \"id\" and\n"
                  "options of this shape if need be; - is standard input")
      ->type_name("FILE");
  verb.add_option("-o,--output", request.outputs.folder, "Folder for results and skeletons")
      ->required()
      ->type_name("DIR");
  add_run_options(verb, words);
  request.options.extraction.threads = 1;
  add_extraction_options(verb, request.options.extraction);
  add_limit_options(verb, request.limits);
  verb.get_option("--timeout")->description("Seconds at most for one shape, 0 for no limit");
  verb.add_option("--max-rss", words.megabytes, "Megabytes of memory at most for one shape")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 32).description(""))
      ->type_name("MB")
      ->group(kLimitGroup);
}

}  // namespace

void add_batch_command(CLI::App& program) {
  const auto words = std::make_shared<BatchWords>();
  words->request.jobs = 0;
  CLI::App* verb = program.add_subcommand("batch", "The curve-skeletons of many shapes");
  add_options(*verb, *words);
  verb->footer(
      "Each shape has a process of its own: a crash, a hang or a memory hog becomes a row of\n"
      "DIR/results-I-of-N.jsonl like any other failure, and the exit status 9. A shape is called\n"
      "by its path, or by its \"id\", without \".\" and \"..\"; the second of a name is NAME~2.\n"
      "Skeletons are DIR/skeletons/NAME.skel, pictures DIR/pictures/NAME.png, maps DIR/maps. "
      "Ctrl-C lets the\n"
      "shapes under way end. marrow merge makes one file of all rows.\n"
      "\n"
      "Examples:\n"
      "  marrow batch shapes -o out --format skel,json --render\n"
      "  marrow batch --manifest shapes.txt -o out --shard 3/100 --timeout 60 --max-rss 2000\n"
      "  marrow batch --manifest shapes.txt -o out --resume --retry\n"
      "\n"
      "  A line of a manifest: {\"path\": \"scan.ply\", \"id\": \"fox\", \"image\": 512, "
      "\"min_part\": 5}\n");
  verb->callback([words] { run_words(*words); });
}

}  // namespace marrow
