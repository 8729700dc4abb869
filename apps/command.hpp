// The verbs of the program and what they share.
#pragma once

#include <marrow/shape_io.hpp>
#include <marrow/skeleton_io.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace marrow {

/// Each adds one verb; it runs at the end of CLI::App::parse() and throws marrow::Error.
void add_batch_command(CLI::App& program);
void add_extract_command(CLI::App& program);
void add_compare_command(CLI::App& program);
void add_convert_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_check_command(CLI::App& program);
void add_make_command(CLI::App& program);
void add_map_command(CLI::App& program);
void add_merge_command(CLI::App& program);
void add_render_command(CLI::App& program);
void add_view_command(CLI::App& program);

/// Thrown to end the program with this status, when all is said.
struct ExitStatus {
  int value = 0;
};

/// Version of the program and of the libraries in it, a line each.
std::string version_text();
/// "0.1.0".
std::string program_version();

/// Adds `--name`, a format by one of these names, with the help kept short.
CLI::Option* add_format_option(CLI::App& verb, const std::string& name, std::string& format,
                               const std::string& words, const std::vector<std::string>& formats);

/// The names that --from takes for a shape, a cloud or a volume, and with skeletons too.
std::vector<std::string> input_formats();
std::vector<std::string> input_and_skeleton_formats();

/// The format that the extension of a path names: what is compressed shows in the bytes, so .gz
/// does not count; and "polylines" for .polylines.txt.
std::string input_format_of(const std::string& path);

/// A file as it was read, before anything is known about its words.
struct InputFile {
  std::string name;    ///< for messages: the path, or "standard input"
  std::string format;  ///< extension, or what --from says
  std::string bytes;
  ReadOptions limits;
};

/// Reads `path`; "-" is standard input and needs `from`. Throws Error: Usage, CannotRead, Limit.
InputFile read_input(const std::string& path, const std::string& from, const ReadOptions& limits);

bool is_skeleton(const InputFile& file);
/// Throw Error: Unsupported, Malformed, Empty, Limit.
Shape shape_of(const InputFile& file);
/// Nodes without a radius get `missing_radius` if it is greater than 0.
CurveSkeleton skeleton_of(const InputFile& file, double missing_radius = 0);

/// What --to says, else what the extension says. Throw Error: Usage ("-" without --to),
/// Unsupported.
ShapeFormat output_shape_format(const std::string& path, const std::string& to);
SkeletonFormat output_skeleton_format(const std::string& path, const std::string& to);

/// A file to write; "-" is standard output.
struct OutputFile {
  std::string path;
  std::string bytes;
};

/// Refuses an output before any work is done for it: two outputs of one name, an output that is
/// the input, a folder that is not there. Throws Error: Usage, CannotWrite.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Refuses a folder that cannot be made or is no folder. Throws Error: CannotWrite.
void check_folder(const std::string& folder);

/// Makes `folder` if it is named and not there, and writes all files; when one fails, those before
/// it are removed again. Throws Error: CannotWrite.
void write_outputs(const std::vector<OutputFile>& files, const std::string& folder = "");

/// One line of words on standard error: "marrow: warning: ...".
void warn(const std::string& words);
/// `words` without anything that would start a second line or drive a terminal.
std::string one_line(std::string words);

}  // namespace marrow
