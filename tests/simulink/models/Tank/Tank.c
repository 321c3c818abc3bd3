/* SPDX-License-Identifier: Apache-2.0 */
#include "Tank.h"

static B_Tank_T Tank_B;
static real_T Tank_level;
ExtU_Tank_T Tank_U;
ExtY_Tank_T Tank_Y;

void Tank_output(void)
{
  Tank_Y.level = Tank_level;
  Tank_B.Balance = Tank_U.inflow - 0.125 * Tank_level;
}

void Tank_update(void)
{
  Tank_level += Tank_B.Balance;
}

void Tank_initialize(void)
{
  Tank_level = 2.0;
  Tank_U.inflow = 0.0;
}

void Tank_terminate(void)
{
}
