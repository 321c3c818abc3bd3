# SPDX-License-Identifier: Apache-2.0
# cmake -DSIL=awe_sil -DHOST=watch_kite -DVERSION=2|3 -DPLANT=folder -DPROGRAMS=folder
#     -DPART=plant_part -DWORK=folder -P ...
# A plant whose clock a host turns has the values of awe_sil, to the last bit, for 60 s.
set(report ${WORK}/held${VERSION}.json)
execute_process(COMMAND ${SIL} --lockstep --duration 60 --report ${report} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${report} text)
string(JSON digest GET "${text}" image_digest)
string(JSON energy GET "${text}" energy_J)
execute_process(COMMAND ${HOST} ${VERSION} ${PLANT} ${PROGRAMS} ${PART} 60 OUTPUT_VARIABLE held
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT held STREQUAL "${digest} ${energy}")
    message(FATAL_ERROR "the plant in a host has the digest and energy ${held}, awe_sil ${digest} ${energy}")
endif()
message(STATUS "digest and energy ${held} in both")
