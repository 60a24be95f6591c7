# Cairo with what it draws text by, as archives where the system has them: with the shared library every command
# would load twenty libraries at its start, the window system's among them (docs/performance.md, "How long a start takes").
set(usual_suffixes ${CMAKE_FIND_LIBRARY_SUFFIXES})
set(CMAKE_FIND_LIBRARY_SUFFIXES .a ${usual_suffixes})
pkg_check_modules(DRAWING REQUIRED IMPORTED_TARGET cairo pixman-1 fontconfig freetype2 expat libbrotlidec libbrotlicommon)
set(CMAKE_FIND_LIBRARY_SUFFIXES ${usual_suffixes})
target_link_libraries(PkgConfig::DRAWING INTERFACE PkgConfig::PNG ZLIB::ZLIB)
