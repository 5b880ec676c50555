# Deliberate breaks of our own code. A mutant is the program mutant_test with one text of one product source replaced: the
# broken translation units are linked before the libraries, so that they take the place of the archives' members.

# What all of them share: places to bake and what to say of them, compiled once.
add_library(mutation_places OBJECT mutant_test.cpp places.cpp silhouette.cpp)
veduta_target(mutation_places)
target_link_libraries(mutation_places PUBLIC veduta_worker veduta_verify)

# mutant_program(NAME SOURCES...): mutant_test with these translation units instead of the product's own.
function(mutant_program name)
  add_executable(${name} ${ARGN})
  veduta_target(${name})
  target_link_libraries(${name} PRIVATE mutation_places)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/mutants)
  if(NOT TARGET tests_mutation)
    add_custom_target(tests_mutation)
  endif()
  add_dependencies(tests_mutation ${name})
endfunction()

function(mutation_test name)
  add_test(NAME mutation.${name} COMMAND ${ARGN})
  set_tests_properties(mutation.${name} PROPERTIES LABELS mutation TIMEOUT 120 SKIP_RETURN_CODE 77)
endfunction()

# broken_copy(NAME FILE REPLACE WITH DIRECTORY): FILE with one text replaced, as DIRECTORY/FILE. A text that is not there
# exactly once stops the configuration: a mutant must never silently become the original.
function(broken_copy name file replace with directory)
  set(path ${PROJECT_SOURCE_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} original)
  string(FIND "${original}" "${replace}" first)
  string(FIND "${original}" "${replace}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "mutant ${name}: ${file} must hold this text exactly once; change it in tests/mutation: ${replace}")
  endif()
  string(REPLACE "${replace}" "${with}" broken "${original}")
  # Written only when it changes, so that nothing is compiled again for nothing.
  file(WRITE ${directory}/${file}.new "${broken}")
  file(COPY_FILE ${directory}/${file}.new ${directory}/${file} ONLY_IF_DIFFERENT)
endfunction()

# veduta_mutant(NAME FILE path REPLACE text WITH text PLACES names... [COMPILE sources...] [SOUND])
# FILE is a source, or a header with the sources that are to be compiled with it (COMPILE). The test passes when rays into the
# model find something falsely invisible at one of the places; with SOUND, when they find nothing: a break that cannot make
# an error, and why is said in docs/mutation.md.
function(veduta_mutant name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SOUND" "FILE;REPLACE;WITH" "PLACES;COMPILE")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_REPLACE OR arg_REPLACE STREQUAL arg_WITH)
    message(FATAL_ERROR "mutant ${name}: give FILE, REPLACE, WITH and PLACES; not understood: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${name})
  broken_copy(${name} ${arg_FILE} "${arg_REPLACE}" "${arg_WITH}" ${directory})
  if(arg_COMPILE)
    list(TRANSFORM arg_COMPILE PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  else()
    set(sources ${directory}/${arg_FILE})
  endif()
  mutant_program(mutant_${name} ${sources})
  target_include_directories(mutant_${name} BEFORE PRIVATE ${directory})  # a broken header is found before the sound one
  set(expected caught)
  if(arg_SOUND)
    set(expected sound)
  endif()
  mutation_test(${name} mutant_${name} ${expected} ${arg_PLACES})
endfunction()
