/* SPDX-License-Identifier: Apache-2.0 */
/* The example that comes with an export: not a part of the node. */
#include "Pendulum.h"

int main(void)
{
  Pendulum_initialize();
  Pendulum_step();
  return 0;
}
