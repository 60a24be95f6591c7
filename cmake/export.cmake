# The Python files that `stilb export` writes beside a scene for Mitsuba, as texts in the library stilb_io.
set(python ${PROJECT_SOURCE_DIR}/src/io/export/mitsuba)
foreach(file stilb_plugins measure)
  file(READ ${python}/${file}.py PYTHON_${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${python}/${file}.py)
endforeach()
configure_file(${python}/python_files.cpp.in ${CMAKE_BINARY_DIR}/made/python_files.cpp @ONLY)
target_sources(stilb_io PRIVATE ${CMAKE_BINARY_DIR}/made/python_files.cpp)
