#pragma once
// Can a run have the threads that it is asked for?

namespace puffin::tools {

/// Throws ResourceError if the system does not start `wanted` threads at once (its limits of processes or of address
/// space). More than there are processors are tried out: oneTBB ends the program when it gets one too few.
void require_threads(int wanted);

}  // namespace puffin::tools
