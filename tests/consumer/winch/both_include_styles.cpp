// SPDX-License-Identifier: Apache-2.0
// The headers have to be found under each of their names: with the folder, without it, and the
// umbrella that is called like the folder.
#include <QPlcMasterNode.h>
#include <QtPlc/QPlcSlaveNode.h>
#include <QtPlc/QtPlcCore>
#include <QtPlc>

int main() { return QPlcClock::lockstep().isLockstep() ? 0 : 1; }
