// SPDX-License-Identifier: Apache-2.0
#include "CompactModelNode.h"
#include "ModelProgram.h"

int main(int argc, char **argv)
{
    return awe::runModelProgram<awe::CompactModelNode>(
        argc, argv, QStringLiteral("The kite on its tether, as a node of a QtPLC master (written with ports)."));
}
