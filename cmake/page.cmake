# The page of `stilb view`: built from web/ by npm and vite, and compiled into the library stilb_page
# (src/walk/page.h). All happens in a copy of web/ in the build tree, so that the source tree stays clean.
find_program(STILB_NODE NAMES node nodejs REQUIRED)
find_program(STILB_NPM npm REQUIRED)

set(web ${PROJECT_SOURCE_DIR}/web)
set(page ${CMAKE_BINARY_DIR}/page)
file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/test/*)
set(page_settings ${web}/index.html ${web}/vite.config.js ${web}/tsconfig.json ${web}/embed.mjs)

# Without install scripts: none of the packages needs its own.
add_custom_command(
  OUTPUT ${page}/installed
  COMMAND ${CMAKE_COMMAND} -E make_directory ${page}
  COMMAND ${CMAKE_COMMAND} -E copy ${web}/package.json ${web}/package-lock.json ${page}
  COMMAND ${CMAKE_COMMAND} -E chdir ${page} ${STILB_NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
  COMMAND ${CMAKE_COMMAND} -E touch ${page}/installed
  DEPENDS ${web}/package.json ${web}/package-lock.json
  COMMENT "Installing the npm packages of the page"
  VERBATIM)

add_custom_command(
  OUTPUT ${page}/page_files.cpp
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${page}/src ${page}/test
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/src ${page}/src
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/test ${page}/test
  COMMAND ${CMAKE_COMMAND} -E copy ${page_settings} ${page}
  COMMAND ${CMAKE_COMMAND} -E chdir ${page} ${STILB_NODE} node_modules/vite/bin/vite.js build --logLevel warn
  COMMAND ${STILB_NODE} ${page}/embed.mjs ${page}/dist ${page}/page_files.cpp
  DEPENDS ${page}/installed ${page_sources} ${page_settings}
  COMMENT "Building the page of stilb view"
  VERBATIM)

add_library(stilb_page STATIC ${page}/page_files.cpp)
target_link_libraries(stilb_page PUBLIC stilb_options)

# Tests in a headless Chromium: one ctest entry per file.
function(stilb_page_tests)
  find_program(STILB_CHROMIUM NAMES chromium chromium-browser google-chrome)
  if(NOT STILB_CHROMIUM)
    message(STATUS "Page tests are skipped: Chromium is missing")
  endif()
  set(environment "STILB_PAGE=${page}/dist;STILB_CHROMIUM=${STILB_CHROMIUM}"
      "STILB=$<TARGET_FILE:stilb>;STILB_SCENES=${PROJECT_SOURCE_DIR}/scenes")
  add_test(NAME page:types COMMAND ${STILB_NODE} node_modules/typescript/bin/tsc WORKING_DIRECTORY ${page})
  file(GLOB tests CONFIGURE_DEPENDS ${web}/test/*.test.mjs)
  foreach(file ${tests})
    cmake_path(GET file FILENAME name)
    string(REPLACE ".test.mjs" "" test ${name})
    if(STILB_SANITIZE AND test STREQUAL accuracy)  # half an hour of pictures, whose code other tests check for memory
      continue()
    endif()
    add_test(NAME page:${test} COMMAND ${STILB_NODE} --test ${page}/test/${name} WORKING_DIRECTORY ${page})
    # Drawing in software takes all cores.
    set_tests_properties(page:${test} PROPERTIES
                         ENVIRONMENT "${environment}"
                         SKIP_REGULAR_EXPRESSION "page test skipped" PROCESSORS 2 TIMEOUT 300)
  endforeach()
endfunction()
