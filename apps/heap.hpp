// The heap of the program.
#pragma once

namespace marrow {

/// To be called first: memory that is given back stays with the process, and the system hands it
/// out in large pages where it can. The stages of one extraction take and leave much memory, and a
/// page that comes anew costs as much time as filling it several times over. Does nothing where the
/// memory of the process is limited.
void prepare_heap();

}  // namespace marrow
