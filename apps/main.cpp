// The program `marrow`: verbs, and what their failures mean to the shell.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command.hpp"
#include "heap.hpp"
#include "process.hpp"

namespace marrow {

namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  marrow make quadruped -o animal.obj         a shape to begin with\n"
    "  marrow extract animal.obj -o animal.skel    its curve-skeleton\n"
    "  marrow convert animal.skel animal.vtp       the same for ParaView\n"
    "  marrow info animal.skel                     what is in it\n"
    "  marrow check animal.obj animal.skel         how good it is\n"
    "  marrow render animal.obj animal.skel -o animal.png\n"
    "\n"
    "Exit status: 0 done, 1 internal error, 2 usage, 3 cannot read, 4 malformed file,\n"
    "5 unsupported, 6 nothing to skeletonise, 7 a limit was hit, 8 cannot write,\n"
    "9 a batch ended with failures, 10 a check failed.\n";

void set_up(CLI::App& program) {
  program.name("marrow");
  program.description("Curve-skeletons of 3D shapes from their silhouettes.");
  program.footer(kExamples);
  program.set_version_flag("--version", version_text, "Versions of marrow and its libraries");
  program.require_subcommand(1);
  add_batch_command(program);
  add_extract_command(program);
  add_compare_command(program);
  add_convert_command(program);
  add_info_command(program);
  add_check_command(program);
  add_make_command(program);
  add_map_command(program);
  add_merge_command(program);
  add_render_command(program);
  add_view_command(program);
}

/// What the parser says about a wrong command line, and where to read on.
[[noreturn]] void refuse(const CLI::App& program, const CLI::ParseError& e) {
  std::string verb;
  for (const CLI::App* chosen : program.get_subcommands()) verb = " " + chosen->get_name();
  std::string what = e.what();
  if (verb.empty() && e.get_name() == "RequiredError") {
    const std::vector<std::string> others = program.remaining();
    what = others.empty() ? "a verb is missing" : others.front() + " is not a verb of marrow";
  }
  throw Error(ErrorKind::Usage, what + "; see marrow" + verb + " --help");
}

void run(int argc, char** argv) {
  CLI::App program;
  set_up(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    write_file("-", version.what());
  } catch (const CLI::CallForHelp&) {
    write_file("-", program.help());
  } catch (const CLI::ParseError& e) {
    refuse(program, e);
  }
}

int fail(ErrorKind kind, const char* words) {
  std::fprintf(stderr, "marrow: %s\n", words);
  return static_cast<int>(kind);
}

}  // namespace

}  // namespace marrow

int main(int argc, char** argv) {
  using namespace marrow;
  prepare_heap();
  prepare_process();
  try {
    run(argc, argv);
    return 0;
  } catch (const ExitStatus& status) {
    return status.value;
  } catch (const Error& e) {
    return fail(e.kind(), one_line(e.what()).c_str());
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::Limit, "out of memory; use a smaller shape, --image or --grid");
  } catch (const std::exception& e) {
    return fail(ErrorKind::Internal,
                (std::string("internal error: ") + one_line(e.what())).c_str());
  } catch (...) {
    return fail(ErrorKind::Internal, "internal error");
  }
}
