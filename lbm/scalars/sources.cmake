# The scalars' part of the library; paths are relative to lbm/.
set(PUFFIN_SCALAR_SOURCES
  scalars/advance_scalars.cpp
  scalars/busy_runs.cpp
  scalars/check_fluxes.cpp
  scalars/diffuse_lines.cpp
  scalars/held_faces.cpp
  scalars/max_steps.cpp
  scalars/scalar_fields.cpp
  scalars/sub_step.cpp
  scalars/sweep_avx2.cpp
  scalars/sweep_avx512.cpp
  scalars/sweep_baseline.cpp
  scalars/sweep_direction.cpp
  scalars/wall_sinks.cpp)
# Contraction stays off (puffin_flags): every instruction set gives the same bits. Nobody reads floating-point exception flags;
# saying so changes no value and lets the compiler turn selections into masks.
set(sweep_flags -fno-trapping-math -Wno-psabi)
set_source_files_properties(scalars/sweep_baseline.cpp PROPERTIES COMPILE_OPTIONS "${sweep_flags}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND sweep_flags -mavx2)
endif()
set_source_files_properties(scalars/sweep_avx2.cpp PROPERTIES COMPILE_OPTIONS "${sweep_flags}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND sweep_flags -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512 -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
set_source_files_properties(scalars/sweep_avx512.cpp PROPERTIES COMPILE_OPTIONS "${sweep_flags}")
