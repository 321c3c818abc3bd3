// SPDX-License-Identifier: Apache-2.0
#include "ModelNode.h"
#include "ModelProgram.h"

int main(int argc, char **argv)
{
    return awe::runModelProgram<awe::ModelNode>(
        argc, argv,
        QStringLiteral("The kite on its tether, as a node of a QtPLC master (written with lists of values)."));
}
