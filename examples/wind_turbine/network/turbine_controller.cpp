// SPDX-License-Identifier: Apache-2.0
// The controller as a program: the node of a plant that OpenFAST holds.
#include "../TurbineController.h"

int main(int argc, char **argv)
{
    return QPlcNodeApplication::run<TurbineController>(argc, argv);
}
