# SPDX-License-Identifier: Apache-2.0
# armhf (BeagleBone, Raspberry Pi 2 and all later ones with a 32-bit system) on a Debian computer,
# with the libraries of a folder that scripts/sysroot armhf makes: build/sysroot-armhf, or what
# QTPLC_SYSROOT says.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_C_COMPILER arm-linux-gnueabihf-gcc)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
set(CMAKE_LIBRARY_ARCHITECTURE arm-linux-gnueabihf)
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi) # notes about compilers before GCC 7, in each file
if(NOT QTPLC_SYSROOT)
    get_filename_component(QTPLC_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-armhf ABSOLUTE)
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES QTPLC_SYSROOT)
if(NOT EXISTS ${QTPLC_SYSROOT}/usr/include)
    message(FATAL_ERROR
        "there is no sysroot in ${QTPLC_SYSROOT}; remedy: scripts/sysroot armhf, or -DQTPLC_SYSROOT=FOLDER")
endif()
set(CMAKE_SYSROOT ${QTPLC_SYSROOT})
set(CMAKE_FIND_ROOT_PATH ${QTPLC_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${QTPLC_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${QTPLC_SYSROOT}/usr/lib/arm-linux-gnueabihf/pkgconfig:${QTPLC_SYSROOT}/usr/share/pkgconfig)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm-static;-L;${QTPLC_SYSROOT})
