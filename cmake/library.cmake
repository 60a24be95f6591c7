# The library stilb::stilb: all folders up to the public interface in one archive, and its CMake package.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(folders base math statistics exact geometry materials lights scene rays sensors patches fit transport checks
            estimators run io api)
list(TRANSFORM folders REPLACE "(.+)" "$<TARGET_OBJECTS:stilb_\\1>" OUTPUT_VARIABLE objects)
add_library(stilb_library ${objects})
add_library(stilb::stilb ALIAS stilb_library)
set_target_properties(stilb_library PROPERTIES OUTPUT_NAME stilb EXPORT_NAME stilb LINKER_LANGUAGE CXX
                                               VERSION ${PROJECT_VERSION} SOVERSION 0)
target_compile_features(stilb_library INTERFACE cxx_std_20)
target_include_directories(stilb_library INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# What the package has to find again, where the library is static (stilbConfig.cmake.in).
target_link_libraries(stilb_library PRIVATE Threads::Threads embree TBB::tbb fmt::fmt OpenEXR::OpenEXR
                                            TinyGLTF::TinyGLTF PkgConfig::EPOXY PkgConfig::PNG PkgConfig::STB
                                            PkgConfig::TOMLPLUSPLUS PkgConfig::POLYCLIPPING)

install(TARGETS stilb_library EXPORT stilb)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/stilb DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/stilb)
install(EXPORT stilb NAMESPACE stilb:: FILE stilbTargets.cmake DESTINATION ${package_directory})
configure_package_config_file(cmake/stilbConfig.cmake.in ${PROJECT_BINARY_DIR}/stilbConfig.cmake
                              INSTALL_DESTINATION ${package_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stilbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stilbConfig.cmake ${PROJECT_BINARY_DIR}/stilbConfigVersion.cmake
        DESTINATION ${package_directory})
