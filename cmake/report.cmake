# The style sheet of reports, as a text in the library stilb_report.
set(style ${PROJECT_SOURCE_DIR}/src/report)
file(READ ${style}/report.css REPORT_STYLE)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${style}/report.css)
configure_file(${style}/style.cpp.in ${CMAKE_BINARY_DIR}/made/report_style.cpp @ONLY)
target_sources(stilb_report PRIVATE ${CMAKE_BINARY_DIR}/made/report_style.cpp)
