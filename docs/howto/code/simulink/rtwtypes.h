// SPDX-License-Identifier: Apache-2.0
// Stands for the header of MATLAB that comes with the exported code.
#ifndef RTWTYPES_H
#define RTWTYPES_H

typedef double real_T;

#endif
