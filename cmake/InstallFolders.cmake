# Where an installation puts what. On Debian libraries lie where its linker and package tools look for them,
# whatever the prefix.
if(CMAKE_LIBRARY_ARCHITECTURE AND EXISTS /etc/debian_version)
    set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries (GNUInstallDirs)")
endif()
include(GNUInstallDirs)
