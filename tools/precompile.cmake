# PUFFIN_PRECOMPILE: the headers that nearly every source includes are parsed once a library. Takes a third off a compilation
# (docs/decisions/0022-checks-within-25-minutes.md). Off by default: compilers' caches do not see through such headers.
function(puffin_precompile target)
  if(NOT PUFFIN_PRECOMPILE)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <fstream>
    <functional> <limits> <map> <memory> <numbers> <optional> <random> <span> <sstream> <stdexcept> <string> <variant> <vector>
    ${ARGN})
endfunction()
