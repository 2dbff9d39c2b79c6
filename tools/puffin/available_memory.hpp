#pragma once

namespace puffin::tools {

/// [byte] that this program could still take: what Linux has available (without /proc: what is free), less where a
/// limit of the process (ulimit -v) or of its control group (a container, a batch system; versions 1 and 2) leaves
/// less. Infinity where nothing says.
double available_memory();

}  // namespace puffin::tools
