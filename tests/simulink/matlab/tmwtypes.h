/* SPDX-License-Identifier: Apache-2.0 */
/* Stands for the header of MATLAB that comes with exported code. */
#ifndef tmwtypes_h
#define tmwtypes_h

typedef signed char int8_T;
typedef unsigned char uint8_T;
typedef short int16_T;
typedef unsigned short uint16_T;
typedef int int32_T;
typedef unsigned int uint32_T;
typedef float real32_T;
typedef double real64_T;
typedef double real_T;
typedef double time_T;
typedef unsigned char boolean_T;
typedef int int_T;
typedef unsigned int uint_T;
typedef char char_T;

#endif
