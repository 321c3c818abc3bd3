// SPDX-License-Identifier: Apache-2.0
#include "QPlcCoreApplication.h"

QPlcCoreApplication::QPlcCoreApplication(int &argc, char **argv)
    : QCoreApplication(argc, argv)
{
    startAsynchronousLogging();
}

QPlcCoreApplication::~QPlcCoreApplication() = default;
