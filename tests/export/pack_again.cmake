# SPDX-License-Identifier: Apache-2.0
# cmake -DPACKER=program -DLIBRARY=file -DFMU=file -DWORK=folder -P ...
# A second file of the same library has the same bytes, whatever the time is.
execute_process(COMMAND ${PACKER} 2 linux64 ${LIBRARY} ${WORK}/again.fmu COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/again.fmu ${FMU} COMMAND_ERROR_IS_FATAL ANY)
