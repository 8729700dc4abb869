// What the process owes to the shell that started it.
#pragma once

namespace marrow {

/// Closed standard files are opened on nothing, so that no other file can take their place, and
/// signals that end the program remove temporary files first: exit status 130 for SIGINT, 143 for
/// SIGTERM, 129 for SIGHUP; 8, without a word, when nobody reads what we write any more (SIGPIPE).
void prepare_process();

}  // namespace marrow
