# What a prefix gets: the program, and what users' kernels are written and tested with. The library
# is not installed: its interface is not promised to stay.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(TILELIGHT_INSTALL_KERNELDIR ${CMAKE_INSTALL_INCLUDEDIR}/tilelight/kernels)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tilelight)

install(TARGETS tilelight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY kernels/ DESTINATION ${TILELIGHT_INSTALL_KERNELDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN images EXCLUDE)
configure_package_config_file(
    cmake/tilelightConfig.cmake.in ${PROJECT_BINARY_DIR}/tilelightConfig.cmake
    INSTALL_DESTINATION ${package_dir}
    PATH_VARS CMAKE_INSTALL_BINDIR TILELIGHT_INSTALL_KERNELDIR)
write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/tilelightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tilelightConfig.cmake
              ${PROJECT_BINARY_DIR}/tilelightConfigVersion.cmake
              cmake/TilelightKernelCheck.cmake
        DESTINATION ${package_dir})
