/* SPDX-License-Identifier: Apache-2.0 */
#include "Gearbox.h"

#include <string.h>

/* A variable that a program of Qt could not have with the keywords of Qt. */
static int_T signals;

void Gearbox_step(RT_MODEL_Gearbox_T *const Gearbox_M)
{
  DW_Gearbox_T *states = Gearbox_M->dwork;
  ExtU_Gearbox_T *in = Gearbox_M->inputs;
  ExtY_Gearbox_T *out = Gearbox_M->outputs;
  int_T row, column;
  out->driveOut = in->drive;
  out->driveOut.shaft.speed = (int16_T)(in->drive.shaft.speed >> 1);
  out->gear = in->gear;
  for (row = 0; row < Gearbox_rows; row++) {
    for (column = 0; column < 3; column++) {
      /* Matrices are stored by columns: row i and column j are element 2 j + i. */
      out->inertia[Gearbox_rows * column + row] = in->inertia[Gearbox_rows * column + row] * (row == 0 ? 10.0 : 1.0);
      out->map[row][column] = in->inertia[Gearbox_rows * column + row];
    }
  }
  for (column = 0; column < 3; column++) {
    out->locks[column] = (boolean_T)!in->locks[column];
  }
  out->moving = (boolean_T)(in->drive.shaft.speed != 0);
  out->count = states->Count_DSTATE;
  states->Count_DSTATE++;
  signals++;
}

void Gearbox_initialize(RT_MODEL_Gearbox_T *const Gearbox_M)
{
  Gearbox_M->errorStatus = ((void *)0);
  (void)memset((void *)Gearbox_M->inputs, 0, sizeof(ExtU_Gearbox_T));
  (void)memset((void *)Gearbox_M->outputs, 0, sizeof(ExtY_Gearbox_T));
  Gearbox_M->dwork->Count_DSTATE += 7U;
}

void Gearbox_terminate(RT_MODEL_Gearbox_T *const Gearbox_M)
{
  (void)Gearbox_M;
}
