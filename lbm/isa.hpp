#pragma once
// Which instruction set the kernels use: the best one of the processor, or a lesser one that the environment variable
// PUFFIN_ISA names (baseline, avx2, avx512). Results have equal bits for any number of threads on each of them; between
// them they differ by rounding, because a fused multiply-add rounds once where the baseline rounds twice.

#include <optional>
#include <string_view>

#include "lbm/kernel.hpp"

namespace puffin::lbm {

/// What the processor offers, whatever PUFFIN_ISA says.
Isa hardware_isa();
/// Nothing if no instruction set has this name.
std::optional<Isa> isa_named(std::string_view name);
/// The kernels' choice (detect_isa) where PUFFIN_ISA has this value; null: it is not set. A name that is unknown, or
/// that this processor does not offer, chooses nothing: the hardware's best stays. Callers who want to refuse ask
/// isa_problem.
Isa isa_for(const char* wanted);
/// What is wrong with this value of PUFFIN_ISA, and what may stand there; empty if nothing is.
std::string_view isa_problem(const char* wanted);

}  // namespace puffin::lbm
