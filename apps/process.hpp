// What the process owes to the shell that started it.
#pragma once

#include <string>

namespace marrow {

/// Closed standard files are opened on nothing, so that no other file can take their place, and
/// signals that end the program remove temporary files first: exit status 130 for SIGINT, 143 for
/// SIGTERM, 129 for SIGHUP; 8, without a word, when nobody reads what we write any more (SIGPIPE).
void prepare_process();

/// After `seconds` the program ends with exit status 7 and `words` as its last line, wherever it
/// is; temporary files are removed first. To be called once.
void end_after(int seconds, const std::string& words);

}  // namespace marrow
