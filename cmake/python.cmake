# Sets TVG_HAS_PYTHON: whether there is an interpreter, Python3::Interpreter, that can load the C interface as it is built.
# A library with sanitizers in it cannot be loaded by an interpreter without.
find_package(Python3 3.9 COMPONENTS Interpreter)
get_target_property(tvg_c_type tvg_c TYPE)
if(Python3_Interpreter_FOUND AND NOT TVG_SANITIZE AND NOT CMAKE_CROSSCOMPILING AND tvg_c_type STREQUAL SHARED_LIBRARY)
  set(TVG_HAS_PYTHON ON)
else()
  set(TVG_HAS_PYTHON OFF)
  message(STATUS "No Python 3.9, or no shared library for it: what stands on the Python package is left out")
endif()
