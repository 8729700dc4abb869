// Files in and out, as all verbs treat them.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <algorithm>
#include <filesystem>

#include "command.hpp"
#include "file_kind.hpp"
#include "importer.hpp"
#include "limits.hpp"

namespace marrow {

namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& path) { return path == "-" ? "standard input" : path; }

/// What parse_shape() reads.
std::vector<std::string> shape_formats() {
  return {"obj", "ply", "stl", "off", "xyz", "pts", "txt", "asc", "csv", "pcd"};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A name that the format functions of the library understand.
std::string as_path(const std::string& format) { return "x." + format; }

void require_format(const std::string& path, const std::string& to) {
  if (path == "-" && to.empty())
    throw Error(ErrorKind::Usage, "standard output has no extension; say --to FORMAT");
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return a == b || fs::equivalent(a, b, error);
}

/// Devices and pipes may be named twice: only files are overwritten.
bool is_plain(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !fs::exists(status) || fs::is_regular_file(status);
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::CannotWrite, path + ": cannot be written: " + why);
}

void check_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error))
    cannot_write(path, "there is no folder " + folder.string());
}

/// Whether the folder is new.
bool make_folder(const std::string& folder) {
  std::error_code error;
  const bool is_new = fs::create_directory(folder, error);
  if (error) cannot_write(folder, error.message());
  return is_new;
}

}  // namespace

CLI::Option* add_format_option(CLI::App& verb, const std::string& name, std::string& format,
                               const std::string& words, const std::vector<std::string>& formats) {
  std::string choice;
  for (const std::string& f : formats) choice += (choice.empty() ? "" : "|") + f;
  return verb.add_option(name, format, words)
      ->check(CLI::IsMember(formats).description(""))
      ->type_name(choice);
}

std::vector<std::string> input_formats() {
  std::vector<std::string> formats{"obj", "ply", "stl", "off", "xyz", "pcd"};
  const auto& imported = imported_formats();
  formats.insert(formats.end(), imported.begin(), imported.end());
  formats.insert(formats.end(), {"nrrd", "nii", "binvox", "raw"});
  return formats;
}

std::vector<std::string> input_and_skeleton_formats() {
  std::vector<std::string> formats = input_formats();
  for (const std::string& format : readable_skeleton_formats())
    if (!contains(formats, format)) formats.push_back(format);
  return formats;
}

std::string input_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "txt" && extension_of(path.substr(0, path.size() - 4)) == "polylines")
    return "polylines";
  if (extension != "gz") return extension;
  const std::string inner = extension_of(path.substr(0, path.size() - 3));
  return inner.empty() ? extension : inner;
}

InputFile read_input(const std::string& path, const std::string& from, const ReadOptions& limits) {
  if (path == "-" && from.empty())
    throw Error(ErrorKind::Usage, "standard input has no extension; say --from FORMAT");
  try {
    return {name_of(path), from.empty() ? input_format_of(path) : from,
            read_file(path, limits.max_bytes), limits};
  } catch (const Error& e) {
    throw_with_option(e, "--max-file");
  }
}

bool is_skeleton(const InputFile& file) {
  if (file.format == "obj") return obj_is_skeleton(file.bytes);
  if (file.format == "ply") return ply_is_skeleton(file.bytes);
  if (file.format == "csv") return csv_is_skeleton(file.bytes);
  return contains(readable_skeleton_formats(), file.format);
}

Shape shape_of(const InputFile& file) {
  if (is_imported(file)) return imported_shape(file);
  if (!contains(shape_formats(), file.format))
    throw Error(ErrorKind::Unsupported,
                file.name +
                    ": shapes are OBJ, PLY, STL, OFF, XYZ or PCD files; convert it, or name its "
                    "format by --from");
  try {
    return parse_shape(file.bytes, shape_format_of(as_path(file.format)), file.name, file.limits);
  } catch (const Error& e) {
    throw_with_option(e, "--max-faces");
  }
}

CurveSkeleton skeleton_of(const InputFile& file, double missing_radius) {
  if (!contains(skeleton_formats(), file.format))
    throw Error(ErrorKind::Unsupported,
                file.name +
                    ": no curve-skeleton by its extension; convert it, or name its format "
                    "by --from");
  const SkeletonFormat format = skeleton_format_of(as_path(file.format));
  return parse_skeleton(file.bytes, format, file.name, missing_radius);
}

ShapeFormat output_shape_format(const std::string& path, const std::string& to) {
  require_format(path, to);
  return shape_format_of(to.empty() ? path : as_path(to));
}

SkeletonFormat output_skeleton_format(const std::string& path, const std::string& to) {
  require_format(path, to);
  return skeleton_format_of(to.empty() ? path : as_path(to));
}

void check_outputs(const std::vector<std::string>& outputs,
                   const std::vector<std::string>& inputs) {
  for (auto out = outputs.begin(); out != outputs.end(); ++out) {
    if (out->empty()) throw Error(ErrorKind::Usage, "an output has an empty name");
    for (auto other = outputs.begin(); other != out; ++other)
      if (*out == *other && (*out == "-" || is_plain(*out)))
        throw Error(ErrorKind::Usage, *out + " is asked for twice; give each output its own name");
    if (*out == "-") continue;
    for (const std::string& in : inputs)
      if (in != "-" && is_plain(*out) && is_same_file(*out, in))
        throw Error(ErrorKind::Usage, *out + " is the input; give the output another name");
    check_folder_of(*out);
  }
}

void check_folder(const std::string& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (fs::exists(folder, error)) cannot_write(folder, "it is no folder");
  const fs::path path(folder);
  check_folder_of(path.has_filename() ? folder : path.parent_path().string());
}

void write_outputs(const std::vector<OutputFile>& files, const std::string& folder) {
  std::vector<std::string> written;
  const bool is_new = !folder.empty() && make_folder(folder);
  try {
    for (const OutputFile& file : files) {
      write_file(file.path, file.bytes);
      if (file.path != "-" && is_plain(file.path)) written.push_back(file.path);
    }
  } catch (...) {
    std::error_code ignored;
    for (const std::string& path : written) fs::remove(path, ignored);
    if (is_new) fs::remove(folder, ignored);
    throw;
  }
}

}  // namespace marrow
