# SPDX-License-Identifier: Apache-2.0
# arm64 (Raspberry Pi 3 and later with a 64-bit system, most boards of today) on a Debian computer,
# with the libraries of Debian's multiarch: scripts/test-arm64 --setup installs what is needed.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# Programs of this computer, not of the board: moc and its like.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
# What CTest runs programs of the board with.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
