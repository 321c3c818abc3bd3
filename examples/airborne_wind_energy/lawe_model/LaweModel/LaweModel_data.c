/* SPDX-License-Identifier: Apache-2.0 */
#include "LaweModel.h"

/* Block parameters (default storage) */
P_LaweModel_T LaweModel_P = {
  5.0,
  10.0,
  1.2,
  1000.0,
  9.81,
  180.0,
  { 5.0, 3.0, 0.0 },
  { 74.261065723250582, 44.556639433950352, 49.999999999999993 },
  9.0,
  100.0
};
