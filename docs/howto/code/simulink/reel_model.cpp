// SPDX-License-Identifier: Apache-2.0
#include "ReelModelNode.h"

int main(int argc, char **argv) { return QPlcNodeApplication::run<ReelModelNode>(argc, argv); }
