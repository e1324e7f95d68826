# Debian packages of what is installed; scripts/package builds them.
#
#   tilelight           the component `command`; without the capturing half tilelight-lighting, in its place,
#                       which needs neither OpenGL nor LLVM: for computers that only light
#   libtilelight0.1     `library`
#   libtilelight-dev    `development`
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tilelight)
set(CPACK_PACKAGE_CONTACT "The tilelight authors <tilelight@example.com>" CACHE STRING "Who packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL command)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Drivers are recommended, not needed: devices of others bring theirs, and the reference needs none.
set(driver "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME tilelight)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "tiled deferred shading of glTF scenes and G-buffers
Captures glTF scenes into G-buffers and lights them with OpenCL kernels: many
lights, many frames, on any OpenCL device, or on a CPU alone.")
if(TILELIGHT_LIGHTING)
    set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS ${driver})
endif()
if(NOT TILELIGHT_RASTER)
    set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME tilelight-lighting)
    set(CPACK_DEBIAN_COMMAND_PACKAGE_PROVIDES "tilelight (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_COMMAND_PACKAGE_CONFLICTS tilelight)
    set(CPACK_DEBIAN_COMMAND_PACKAGE_REPLACES tilelight)
    set(CPACK_COMPONENT_COMMAND_DESCRIPTION "tiled deferred shading of G-buffers
Lights captured G-buffers with OpenCL kernels: many lights, many frames, on any
OpenCL device, or on a CPU alone. This is tilelight without the half that
captures scenes.")
endif()
set(documents ${CPACK_DEBIAN_COMMAND_PACKAGE_NAME})

if(TARGET tl_library)
    list(APPEND CPACK_COMPONENTS_ALL library development)
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libtilelight${TILELIGHT_INTERFACE})
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS ${driver})
    set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
    set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
    file(WRITE ${PROJECT_BINARY_DIR}/packages/triggers "activate-noawait ldconfig\n")
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/packages/triggers)
    set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "tiled deferred shading of G-buffers, library
Reads G-buffers, lights and pictures, lights them with OpenCL kernels, and runs
stages after lighting.")
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtilelight-dev)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
        "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS tilelight)
    set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "tiled deferred shading of G-buffers, for programs
Headers, pkg-config and CMake files of libtilelight, and headers for shading
kernels.")
    list(APPEND documents ${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} ${CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME})
endif()

# Each package says whose it is and that it was made. Not of an installation without packages.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog ${PROJECT_BINARY_DIR}/packages/changelog)
foreach(component package IN ZIP_LISTS CPACK_COMPONENTS_ALL documents)
    file(WRITE ${changelog}.${component} "${package} (${PROJECT_VERSION}) unstable; urgency=medium

  * Built from the sources of this version.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
    execute_process(COMMAND gzip -9nf ${changelog}.${component} COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${changelog}.${component}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
            RENAME changelog.gz COMPONENT ${component} EXCLUDE_FROM_ALL)
    install(FILES ${TILELIGHT_COPYRIGHT} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
            RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
