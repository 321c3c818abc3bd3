# SPDX-License-Identifier: Apache-2.0
# kissfft with 32-bit numbers: the target KissFft::KissFft.
find_path(KissFft_INCLUDE_DIR kiss_fftr.h PATH_SUFFIXES kissfft)
find_library(KissFft_LIBRARY NAMES kissfft-float)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(KissFft
    REQUIRED_VARS KissFft_LIBRARY KissFft_INCLUDE_DIR
    REASON_FAILURE_MESSAGE
    "the Control Center computes spectra with it. Debian has it as libkissfft-dev, and \
scripts/setup installs it. Without the window: -DQTPLC_BUILD_GUI=OFF")
mark_as_advanced(KissFft_INCLUDE_DIR KissFft_LIBRARY)
if(KissFft_FOUND AND NOT TARGET KissFft::KissFft)
    add_library(KissFft::KissFft UNKNOWN IMPORTED)
    set_target_properties(KissFft::KissFft PROPERTIES
        IMPORTED_LOCATION ${KissFft_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${KissFft_INCLUDE_DIR}
        INTERFACE_COMPILE_DEFINITIONS "kiss_fft_scalar=float;KISS_FFT_SHARED")
endif()
