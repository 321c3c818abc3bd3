/* SPDX-License-Identifier: Apache-2.0 */
/* Stands for the header of MATLAB that comes with exported code. */
#ifndef RTWTYPES_H
#define RTWTYPES_H

typedef int int_T;
typedef unsigned int uint32_T;
typedef unsigned char boolean_T;
typedef double real_T;
typedef double time_T;
typedef char char_T;

#endif
