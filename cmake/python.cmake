# The Python package: its extension module stilb._stilb, and all of its files together in python/ of the build
# folder, from where tests import it. `pip install .` and `make wheel` come here through scikit-build-core.
set(venv ${PROJECT_SOURCE_DIR}/build/python/venv)
set(STILB_PYTHON AUTO CACHE STRING "Build the Python package: ON, OFF, or AUTO: where `make python-setup` was called")
if(STILB_PYTHON STREQUAL AUTO)
  if(STILB_SANITIZE OR NOT EXISTS ${venv}/ready)  # a Python without sanitizers cannot load a module with them
    return()
  endif()
  set(Python_EXECUTABLE ${venv}/bin/python)
elseif(NOT STILB_PYTHON)
  return()
endif()

find_package(Python 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
execute_process(COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir OUTPUT_VARIABLE nanobind_ROOT
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
find_package(nanobind CONFIG REQUIRED)

set(package ${CMAKE_BINARY_DIR}/python/stilb)
file(GLOB bindings CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/python/bindings/*.cpp)
nanobind_add_module(stilb_python NB_STATIC NB_SUPPRESS_WARNINGS NOMINSIZE ${bindings})
set_target_properties(stilb_python PROPERTIES OUTPUT_NAME _stilb LIBRARY_OUTPUT_DIRECTORY ${package})
target_include_directories(stilb_python PRIVATE ${PROJECT_SOURCE_DIR}/python)
target_link_libraries(stilb_python PRIVATE stilb_api stilb_exact)

set(sources ${PROJECT_SOURCE_DIR}/python/stilb)
file(GLOB modules CONFIGURE_DEPENDS ${sources}/*.py ${sources}/py.typed)
set(stubs ${package}/_stilb/__init__.pyi ${package}/options.pyi ${package}/parts.pyi)
add_custom_command(
  OUTPUT ${stubs}
  COMMAND ${CMAKE_COMMAND} -E copy ${modules} ${package}
  COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/python/make_stubs.py ${package}
  DEPENDS stilb_python ${modules} ${PROJECT_SOURCE_DIR}/python/make_stubs.py
  COMMENT "Writing the type stubs of the Python package"
  VERBATIM)
add_custom_target(stilb_package ALL DEPENDS ${stubs})

install(TARGETS stilb_python LIBRARY DESTINATION stilb COMPONENT python EXCLUDE_FROM_ALL)
install(FILES ${modules} ${package}/options.pyi ${package}/parts.pyi DESTINATION stilb COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY ${package}/_stilb DESTINATION stilb COMPONENT python EXCLUDE_FROM_ALL)
if(SKBUILD)
  install(PROGRAMS $<TARGET_FILE:stilb> DESTINATION ${SKBUILD_SCRIPTS_DIR} COMPONENT python EXCLUDE_FROM_ALL)
endif()
