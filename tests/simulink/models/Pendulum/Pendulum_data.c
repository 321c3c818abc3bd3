/* SPDX-License-Identifier: Apache-2.0 */
#include "Pendulum.h"

/* Block parameters (default storage) */
P_Pendulum_T Pendulum_P = {
  2.0,
  { 0.5, 0.0 },
  3
};
