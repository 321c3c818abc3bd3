// SPDX-License-Identifier: Apache-2.0
#include "Winch.h"

int main(int argc, char **argv)
{
    return QPlcNodeApplication::run<Winch>(argc, argv);
}
