# What a prefix gets, in components that are Debian packages, too (cmake/Packages.cmake):
#
#   command      the program, its manual, completion of its command line, the pages of docs/
#   library      libtilelight; not without the lighting half, nor with sanitizers
#   development  its headers, pkg-config and CMake files, and what users' kernels are written and tested with
include(CMakePackageConfigHelpers)
set(TILELIGHT_INSTALL_KERNELDIR ${CMAKE_INSTALL_INCLUDEDIR}/tilelight/kernels)
# Not below Debian's folder of an architecture, where projects without a language do not look.
set(package_dir lib/cmake/tilelight)

install(TARGETS tilelight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command PATTERN images EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)

# Our licence, and those of what the program holds of others.
set(TILELIGHT_COPYRIGHT ${PROJECT_BINARY_DIR}/copyright)
file(READ LICENSE terms)
if(TILELIGHT_LIGHTING)
    file(READ ${TILELIGHT_D3_LICENCE} d3_terms)
    string(APPEND terms "\nThe program holds d3, under these terms:\n\n${d3_terms}")
endif()
if(TILELIGHT_RASTER)
    string(APPEND terms "\nThe program holds stb_image by Sean Barrett and others, in the public domain.\n")
endif()
file(WRITE ${TILELIGHT_COPYRIGHT} "${terms}")
install(FILES ${TILELIGHT_COPYRIGHT} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)

install(DIRECTORY kernels/ DESTINATION ${TILELIGHT_INSTALL_KERNELDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h")
configure_package_config_file(
    cmake/tilelightConfig.cmake.in ${PROJECT_BINARY_DIR}/tilelightConfig.cmake
    INSTALL_DESTINATION ${package_dir}
    PATH_VARS CMAKE_INSTALL_BINDIR TILELIGHT_INSTALL_KERNELDIR)
write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/tilelightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tilelightConfig.cmake
              ${PROJECT_BINARY_DIR}/tilelightConfigVersion.cmake
              cmake/TilelightKernelCheck.cmake
        DESTINATION ${package_dir} COMPONENT development)

if(NOT TARGET tl_library)
    return()
endif()

# Of the kernels' headers the public ones include these, constants alone, which stand beside them then.
set(shared knobs.h planes.h layout_names.h tones.h models.h aovs.h shadow_code.h)
list(TRANSFORM shared PREPEND kernels/)
install(TARGETS tl_library EXPORT tilelight
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(EXPORT tilelight NAMESPACE tilelight:: FILE tilelightTargets.cmake
        DESTINATION ${package_dir} COMPONENT development)
install(DIRECTORY host/include/tilelight DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(FILES ${shared} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tilelight COMPONENT development)
# From where the file lies to the prefix, which may then be anywhere.
file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/tilelight.pc.in ${PROJECT_BINARY_DIR}/tilelight.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tilelight.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
