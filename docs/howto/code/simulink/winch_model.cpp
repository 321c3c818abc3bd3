// SPDX-License-Identifier: Apache-2.0
#include "WinchModelNode.h"

int main(int argc, char **argv) { return QPlcNodeApplication::run<WinchModelNode>(argc, argv); }
