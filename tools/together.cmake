# PUFFIN_TOGETHER: sources of a target that keep no private name in common are compiled up to eight at a time, which halves what
# sanitizers make dear: 65 -> 32 CPU-s for eight files of cases/. Off by default, as one change then compiles eight files, and
# a forgotten #include is not noticed. The groups are made when cmake runs: run it again if a new private name collides.
# Then a local name may hide a private one of another file (-Wshadow), and g++, which sees through more calls, warns of uninitialised or
# overlong strings that are neither (-Wmaybe-uninitialized, -Wstringop-overflow, -Warray-bounds). No faults, so a build
# in groups does not ask for them; the preset release compiles file by file and does.
# ALONE: files that collide in another way.
function(puffin_together target)
  if(NOT PUFFIN_TOGETHER)
    return()
  endif()
  find_package(Python3 COMPONENTS Interpreter REQUIRED)
  cmake_parse_arguments(ARG "" "" "ALONE" ${ARGN})
  get_target_property(sources ${target} SOURCES)
  list(REMOVE_ITEM sources "" ${ARG_ALONE})
  list(LENGTH sources count)
  if(count EQUAL 1)
    return()
  endif()
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_SOURCE_DIR}/tests/style/groups.py ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9]+ [^\n]+" lines "${lines}")
  foreach(line ${lines})
    string(REGEX REPLACE "^([0-9]+) .*" "\\1" group "${line}")
    string(REGEX REPLACE "^[0-9]+ " "" file "${line}")
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP together_${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_compile_options(${target} PRIVATE -Wno-shadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>)
endfunction()
