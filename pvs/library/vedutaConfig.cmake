# find_package(veduta): target veduta::pvs, which needs nothing but the standard library to compile against.
include(${CMAKE_CURRENT_LIST_DIR}/vedutaTargets.cmake)
