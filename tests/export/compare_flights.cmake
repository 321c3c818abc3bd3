# SPDX-License-Identifier: Apache-2.0
# cmake -DSIL=awe_sil -DHOST=fly_fmus -DVERSION=2|3 -DMODEL=folder -DAUTOPILOT=folder
#     [-DPROGRAM=awe_autopilot] -DWORK=folder -P ...
# Model and autopilot have the same energy, to the last bit, in a plant and as FMUs in another host.
if(PROGRAM)
    get_filename_component(name ${PROGRAM} NAME)
endif()
set(report ${WORK}/flight${VERSION}${name}.json)
execute_process(COMMAND ${SIL} --lockstep --same-cycle --dead-time 1 --duration 120 --report ${report}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${report} text)
string(JSON expected GET "${text}" energy_J)
# Its observer has read the outputs of the cycle before the last one of 12000: those at 119.98 s.
execute_process(COMMAND ${HOST} ${VERSION} ${MODEL} ${AUTOPILOT} 119.98 ${PROGRAM} OUTPUT_VARIABLE energy
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT energy STREQUAL expected)
    message(FATAL_ERROR "the FMUs fly to ${energy} J, the plant to ${expected} J")
endif()
message(STATUS "${energy} J in both")
